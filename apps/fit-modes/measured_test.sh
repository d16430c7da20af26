#!/usr/bin/env bash
# Measured receptances of a milling tool. The files lie beside the checkout where they may be used; elsewhere: skipped.
. "$SOURCE/apps/testing.sh"
measured=$SOURCE/../shared/real/ubc-tool
if [ ! -d "$measured" ]; then
  trap - EXIT
  rm -rf "$scratch"
  echo "skipped: the measured files are not here"
  exit 77
fi
for point in 1 2; do
  fit-modes --band 400:4500 "$measured/point$point.txt" -o fit.json
  check "point $point: fits" test $? -eq 0
  check_jq "point $point: at most 5 % error with at most 12 modes" fit.json '.fit.relative_error <= 0.05 and (.modes | length <= 12)'
  check_jq "point $point: none closer than its half width, none undamped" fit.json '[.modes[] | [.frequency_hz, .damping_ratio]] | . as $m
    | all(.[1] >= 0.0002) and ([range(length)] | all(. as $i | [range($i)] | all(. as $j
      | ($m[$i][0] - $m[$j][0]) >= ([$m[$i][0] * $m[$i][1], $m[$j][0] * $m[$j][1]] | min))))'
  check_jq "point $point: says what stopped it" fit.json '.fit.stopped_by == "model error" and .fit.noise == "estimated"'
done

# With no option at all: what is there of the band, few modes, and the least depth that the banded table has. One raw hit of the tool too.
least_depth() {
  sdm-lobes --quiet "$1" --teeth 4 --kt 750 --kr 225 --milling down --immersion 0.5 --speed 2000:20000:100 --depth 0:20:2 --limit-only |
    jq '[.limit[].depth_mm | numbers] | min'
}
gunzip -c "$SOURCE/../shared/real/raw-hit/hit.txt.gz" >hit.txt
for row in "point1 400:4500 $measured/point1.txt" "point2 400:4500 $measured/point2.txt" "hit 400:3800 --taps x=hit.txt"; do
  read -ra words <<<"$row"
  name=${words[0]} band=${words[1]} arguments=("${words[@]:2}")
  fit-modes --quiet "${arguments[@]}" -o fit.json
  check "$name: fits without a band" test $? -eq 0
  check_jq "$name without a band: at most 5 % error with at most 12 modes" fit.json '.fit.relative_error <= 0.05 and (.modes | length <= 12)'
  fit-modes --quiet "${arguments[@]}" --band "$band" -o banded.json
  check "$name without a band: the least depth within 20 %" jq -en --argjson whole "$(least_depth fit.json)" --argjson banded "$(least_depth banded.json)" \
    '$banded > 1 and $whole > 0.8 * $banded and $whole < 1.2 * $banded'
done

# Point 1 as columns, as CutPro's .frf and as universal files is one measurement, with one table of modes.
columns=$measured/point1.txt
sed '1s/\r*$/\tm\/N/' "$columns" >point1.frf
fit-modes --convert --to uff "$columns" -o point1.uff
fit-modes --convert --to uff-binary "$columns" -o point1-binary.uff
fit-modes --convert --no-provenance "$columns" -o columns.json
fit-modes --quiet --band 400:1500 --modes 3 --no-provenance "$columns" -o modes.json
for file in point1.frf point1.uff point1-binary.uff; do
  fit-modes --convert --no-provenance $file -o other.json
  check "$file holds the same numbers" cmp columns.json other.json
  fit-modes --quiet --band 400:1500 --modes 3 --no-provenance $file -o other.json
  check "$file gives the same modes" cmp modes.json other.json
done
fit-modes --modes 2 "$columns" 2>.err >modes.json
check "the band that integration has ruined is named" grep -Eq 'below [0-9]+ Hz Hxx rises towards 0 Hz' .err

# Files of other programs: time records are refused, an H1 is read.
files=$SOURCE/../shared/real/uff
for file in Sample_UFF58_ascii Sample_UFF58b_bin binary8byte; do
  refused 65 "$file.uff: line 8 \\(function 1, record 6\\): function type 1, a time response: expected type 4" fit-modes "$files/$file.uff"
done
fit-modes --convert "$files/non_ascii_header.uff" -o h1.json 2>.err
check_jq "an H1 with bytes that are not UTF-8" h1.json '.quantity == "accelerance" and .h[0].re[5] == 3.75037 and .h[0].im[5] == 2.93363 and .frequency_hz[1] == 0.195313'
check "without directions" grep -q 'directions 0, which are none: taken as x' .err
