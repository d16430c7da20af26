#!/usr/bin/env bash
# Every form of testdata/taps, each with its expected outcome: the numbers of reference.json, or a refusal with its place.
. "$SOURCE/apps/testing.sh"
cd "$data/taps" || exit 1
got=$scratch/got.json err=$scratch/err

# same_numbers ENTRIES: the converted file holds these entries of the reference, no others, on the same lines. `xx:mobility`
# is in another quantity; `shifted` stands for lines from 0 Hz in steps of 5, the first of them 0.
same_numbers() {
  jq -e --arg entries "$1" --slurpfile reference reference.json '
    def near($a; $b): [$a, $b] | transpose | all((.[0] - .[1] | fabs) <= 2e-6 * ((.[1] | fabs) + 1e-3));
    def power: {"receptance": 2, "mobility": 1, "accelerance": 0}[.];
    def times_s: [-.[2] * .[1], .[2] * .[0], .[2]];  # [re, im, omega]
    . as $got | $reference[0] as $r | ($entries == "shifted") as $shifted
    | ([$entries | split(",")[] | split(":")[0] | if . == "shifted" then "xx" else . end] | sort) as $wanted
    | (($entries | split(":")[1]) // "accelerance") as $quantity
    | $got.quantity == $quantity and (.h | map(.response + .reference) | sort) == $wanted
    and near($got.frequency_hz; if $shifted then [range(12) * 5] else $r.frequency_hz end)
    and all($got.h[]; (.response[:1] + .reference[:1]) as $name
      | (if ($wanted | index("x@1x@2")) then "xx" else $name end) as $own
      | ([$r.h[] | select(.response + .reference == (if $name == "yx" then "yx" else $own end))][0]) as $want
      | [.re, .im, $got.frequency_hz] | transpose | map(.[2] *= 6.283185307179586
          | reduce range($quantity | power) as $i (.; times_s) | .[:2])
      | if $shifted then (.[0] == [0, 0]) and near(map(.[0])[1:]; $want.re[1:]) and near(map(.[1])[1:]; $want.im[1:])
        else near(map(.[0]); $want.re) and near(map(.[1]); $want.im) end)' "$got" >/dev/null
}

while IFS=$'\t' read -r file options status expected remark; do
  [ "${file:0:1}" != '#' ] || continue
  [ "$options" != - ] || options=
  # shellcheck disable=SC2086
  if [ "$status" -ne 0 ]; then
    refused "$status" "^fit-modes: $file: $expected" fit-modes --convert $options "$file"
    continue
  fi
  # shellcheck disable=SC2086
  fit-modes --convert $options "$file" >"$got" 2>"$err"
  check "$file $options: read" test $? -eq 0
  check "$file $options: $expected" same_numbers "$expected"
  if [ "$remark" = - ]; then
    check "$file $options: nothing to remark, not $(cat "$err")" test ! -s "$err"
  else
    check "$file $options: $remark, not $(cat "$err")" grep -Eq -- "$remark" "$err"
  fi
done <expected.tsv
for file in *.uff *.csv *.tsv *.txt *.frf; do
  [[ $file == entry-* || $file == expected.tsv ]] || check "$file is in expected.tsv" grep -q "^$file	" expected.tsv
done

# One file for each entry.
fit-modes --convert --quantity accelerance --entry xx=entry-xx.csv --entry xy=entry-xy.csv --entry yx=entry-yx.csv \
  --entry yy=entry-yy.csv >"$got"
check "entries of four files" same_numbers xx,xy,yx,yy
fit-modes --convert --quantity accelerance --entry -x-x=entry-xx.csv --entry x,y=entry-xy.csv >"$got"
check "signs and commas" same_numbers xx,xy
jq '.h[0].re |= map(-.) | .h[0].im |= map(-.)' "$got" >"$scratch/turned.json"
fit-modes --convert --quantity accelerance --entry x-x=entry-xx.csv --entry x,y=entry-xy.csv >"$scratch/one-sign.json"
check_jq "one sign turns the entry" "$scratch/one-sign.json" '.h == $turned[0].h' --slurpfile turned "$scratch/turned.json"
fit-modes --convert --entry yx=plain.uff >"$got" 2>"$err"
check "the option names the directions" jq -e '.h[0] | .response == "y" and .reference == "x"' "$got" >/dev/null
check "and says that the file says otherwise" grep -q '^fit-modes: warning: plain.uff: says xx: taken for yx' "$err"
refused 65 '^fit-modes: four.uff: 4 entries: expected one in each of several files \(--functions\)' fit-modes --entry xx=four.uff
refused 65 '^fit-modes: entry-xy.csv: xx: expected each pair of directions once' fit-modes --entry xx=entry-xx.csv --entry xx=entry-xy.csv
head -n 11 entry-xy.csv >"$scratch/short.csv"
refused 65 'short.csv: 11 lines from 100 to 150 Hz: expected the lines of the first file, 12' fit-modes --entry xx=entry-xx.csv --entry "xy=$scratch/short.csv"
refused 65 '^fit-modes: plain.uff: accelerance: expected receptance, as in the first file' fit-modes --entry xx=entry-xx.csv --entry xy=plain.uff
refused 64 '^fit-modes: --entry: xx: expected DIRECTIONS=FILE' fit-modes --entry xx
refused 64 '^fit-modes: --entry: x=a.csv: expected DIRECTIONS=FILE' fit-modes --entry x=a.csv
refused 64 '^fit-modes: plain.uff: expected no other input with --entry' fit-modes --entry xx=entry-xx.csv plain.uff
refused 66 '^fit-modes: nowhere.csv: cannot be read' fit-modes --entry xx=nowhere.csv

# What the user could change is named by this tool's option.
fit-modes --convert nodes.uff 2>"$err" >"$got"
check "several nodes" grep -q '^fit-modes: warning: nodes.uff: responses at 1 and forces at 2 nodes: a direction is named with its node, as x@1 (--node)$' "$err"
refused 65 '^fit-modes: twice.uff: .*expected each pair of directions once \(--functions\)$' fit-modes twice.uff
refused 65 '^fit-modes: quantity-unknown.uff: .*does not say what the response is \(--quantity or --unit\)$' fit-modes quantity-unknown.uff
refused 65 '^fit-modes: not-a-unit.csv: .*, as m/N \(--unit\)$' fit-modes not-a-unit.csv

# Options that do not fit.
refused 64 '^fit-modes: --unit: apples/N: expected a unit' fit-modes --unit apples/N three.csv
refused 64 '^fit-modes: --to: expected with --convert or --synthesize' fit-modes --to uff plain.uff
refused 64 '^fit-modes: --modes: expected without --convert' fit-modes --convert --modes 3 plain.uff
refused 64 '^fit-modes: three.csv: expected a universal file with --functions and --node' fit-modes --node 3 three.csv
refused 64 '^fit-modes: reference.json: a frf document says its units' fit-modes --unit um/N reference.json
refused 64 '^fit-modes: --functions: 0: expected a list' fit-modes --functions 0 plain.uff
refused 65 '^fit-modes: plain.uff: function 2: expected one of the file.s 1 functions' fit-modes --functions 2 plain.uff
refused 65 '^fit-modes: plain.uff: node 5: expected a node at which both' fit-modes --node 5 plain.uff
refused 64 '^fit-modes: --window-decay: 0: expected a decay' fit-modes --window-decay 0 plain.uff
refused 65 '^fit-modes: plain.uff: line 2: 58: not JSON' fit-modes --from json plain.uff
refused 65 '^fit-modes: three.csv: .* none of them 58' fit-modes --from uff three.csv

# What is written reads back: binary to the last bit, text to its thirteen digits and then the same.
table=$data/thesis-table-6-2.json
cd "$scratch" || exit 1
fit-modes --synthesize 1:1000:2048 "$table" --no-provenance -o truth.json
for form in uff uff-binary; do
  fit-modes --synthesize 1:1000:2048 "$table" --to $form -o tap.$form
  fit-modes --convert tap.$form --no-provenance -o back.$form.json 2>.err
  check "$form needs no remark" test ! -s .err
  fit-modes --convert back.$form.json --to $form -o again.$form
  check "$form is the same again" cmp tap.$form again.$form
done
check "binary gives the same document" cmp truth.json back.uff-binary.json
check_jq "text gives the same to 13 digits" back.uff.json '[.h, $t[0].h] | transpose | length == 4 and all(
  [.[0].re + .[0].im, .[1].re + .[1].im] | transpose | all((.[0] - .[1] | fabs) <= 5.1e-13 * (.[1] | fabs)))' --slurpfile t truth.json
fit-modes --convert --to uff "$data/carbide-tap.json" 2>.err | fit-modes --convert --no-provenance -o carbide.json
check_jq "a document as universal file and back" carbide.json '.quantity == "receptance" and ([.h[] | .response + .reference] == ["xx", "yy"])'
jq '.h[0].response = "slope_x"' truth.json >slope.json
refused 65 '^fit-modes: slope.json: slope_x: a universal file takes the directions x, y and z' fit-modes --convert --to uff slope.json

# What editors of Windows write: a byte order mark is passed over, UTF-16 is named.
{ printf '\xef\xbb\xbf'; cat truth.json; } >marked.json
fit-modes --convert --no-provenance marked.json -o unmarked.json
check "a document with a byte order mark" cmp unmarked.json <(fit-modes --convert --no-provenance truth.json)
{ printf '\xff\xfe'; iconv -t UTF-16LE truth.json; } >wide.json
refused 65 '^fit-modes: wide.json: UTF-16 text: expected UTF-8' fit-modes --convert wide.json
refused 65 '^fit-modes: wide.json: UTF-16 text: expected UTF-8' fit-modes --synthesize 1:2:3 wide.json
