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
