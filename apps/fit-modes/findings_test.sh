#!/usr/bin/env bash
# Taps with something wrong in them, testdata/taps/findings: each is said in a line, and nothing is said of a sound one.
# Behind them stand three modes: 150 Hz, 3 %; 320 Hz, 2.5 %; 700 Hz, 2 %; noise 40 dB below the signal.
. "$SOURCE/apps/testing.sh"
cd "$data/taps/findings" || exit 1
result=$scratch/modes.json err=$scratch/err
# three_modes: the table holds these poles and no others; of independent or contradicting channels each twice.
three_modes() {
  jq -e '[.modes[] | select(.out_of_band | not) | [.frequency_hz, .damping_ratio]] | . as $m
    | ([[150, 0.03], [320, 0.025], [700, 0.02]] | all(. as $t | any($m[]; (.[0] / $t[0] - 1 | fabs) < 1e-3 and (.[1] / $t[1] - 1 | fabs) < 0.05)))
    and all($m[]; . as $g | any([[150, 0.03], [320, 0.025], [700, 0.02]][]; (.[0] / $g[0] - 1 | fabs) < 0.01))' "$result" >/dev/null
}
while IFS=$'\t' read -r file options expected; do
  [ "${file:0:1}" != '#' ] || continue
  [ "$options" != - ] || options=
  # shellcheck disable=SC2086
  fit-modes $options "$file" -o "$result" 2>"$err"
  check "$file $options: fits" test $? -eq 0
  # What is no receptance has no modes either, drift makes some of its own, and noise leaves fewer digits.
  case "$file $options" in 'accelerance.csv '|'drift.csv '|noise-above*) ;; *) check "$file $options: the three modes" three_modes ;; esac
  if [ "$expected" = - ]; then
    check "$file $options: nothing to say, not $(cat "$err")" test ! -s "$err"
    continue
  fi
  while read -r pattern; do
    check "$file $options: $pattern, not $(cat "$err")" grep -Eq -- "$pattern" "$err"
  done < <(sed 's/ ;; /\n/g' <<<"$expected")
  # shellcheck disable=SC2086
  fit-modes --quiet $options "$file" -o "$result" 2>"$err"
  check "$file $options: --quiet" test ! -s "$err"
done <expected.tsv
for file in *.csv; do check "$file is in expected.tsv" grep -q "^$file	" expected.tsv; done

# What is wrong with an entry is named with what mends it. Here the options break a sound measurement.
for broken in '--delay xy=-0.8:--delay xy=0\.[78][0-9]*' '--delay -1.5:--delay 1\.[45][0-9]*' '--scale xy=1.06:--scale xy=0\.94[0-9]*'; do
  # shellcheck disable=SC2086
  fit-modes ${broken%%:*} sound-2x2.csv -o "$result" 2>"$err"
  check "${broken%%:*}: ${broken#*:}, not $(cat "$err")" grep -Eq -- "${broken#*:}" "$err"
  # shellcheck disable=SC2046,SC2086
  fit-modes ${broken%%:*} $(grep -Eo -- "${broken#*:}" "$err") sound-2x2.csv -o "$result" 2>"$err"
  check "${broken%%:*}: mended, the three modes" three_modes
done

# Drift that takes energy: seen by what a fit leaves of it.
fit-modes --convert sound-2x2.csv | jq '(.frequency_hz | map(if . < 120 then 1e-7 * pow(30 / .; 4) else 0 end)) as $d
  | .h |= map(.re = ([.re, $d] | transpose | map(.[0] - 0.86 * .[1])) | .im = ([.im, $d] | transpose | map(.[0] - 0.51 * .[1])))' >"$scratch/drift.json"
fit-modes "$scratch/drift.json" -o "$result" 2>"$err"
check "drift that no modes explain is left out, not $(cat "$err")" grep -Eq 'below [0-9.]+ Hz: left out of the fit, as no modes of a structure explain what rises towards 0 Hz there' "$err"
check "and the three modes are there" three_modes
fit-modes --band 5:1000 "$scratch/drift.json" -o "$result" 2>"$err"
check "a band keeps it, with a word: $(cat "$err")" grep -Eq 'below [0-9.]+ Hz the curves fall as those of no structure do' "$err"

# The window's decay, as a time constant too; more than a mode has is refused.
fit-modes --window-decay 6 exponential-window.csv --no-provenance -o "$scratch/a.json" --fitted "$scratch/fitted.json"
fit-modes --window-decay 0.16666666666666666s exponential-window.csv --no-provenance -o "$scratch/b.json"
check_jq "a time constant is the inverse of a decay" "$scratch/a.json" '[.modes, $b[0].modes] | transpose | all((.[0].damping_ratio / .[1].damping_ratio - 1) | fabs < 1e-9)' --slurpfile b "$scratch/b.json"
check_jq "the table says so" "$scratch/a.json" '.fit.window_decay_per_s == 6 and .fit.stopped_by == "noise"'
fit-modes exponential-window.csv -o "$scratch/windowed.json"
check_jq "without it the damping is too high" "$scratch/windowed.json" '.modes[0].damping_ratio > 0.035'
refused 1 '^fit-modes: exponential-window.csv: the mode at 150.* Hz decays by 34.* 1/s, less than the window alone' fit-modes --quiet --window-decay 40 exponential-window.csv

# More modes than the noise lets be told: those whose numbers are smaller than their deviations are named, and no others.
fit-modes --synthesize 2:1000:1000 --noise-db 20 "$data/thesis-table-6-2.json" >"$scratch/noisy.json"
fit-modes --modes 30 "$scratch/noisy.json" 2>"$err" >"$scratch/many.json"
vague='def size: [.[][]] | map(. * .) | add | sqrt; [.modes[] | select(.out_of_band | not) | select(.std.damping_ratio > .damping_ratio or (.std.psi_r | size) > (.psi_r | size)
  or (.std.psi_l | size) > (.psi_l | size))] | length'
check "modes of which nothing is told are said" grep -q "noisy.json: damping or vectors of $(jq "$vague" "$scratch/many.json") of $(jq '.modes | length' "$scratch/many.json") modes are smaller" "$err"
fit-modes "$scratch/noisy.json" 2>"$err" >"$scratch/found.json"
check "a table without such modes has no word of them" test "$(jq "$vague" "$scratch/found.json")" -eq 0 -a "$(grep -c 'damping or vectors' "$err")" -eq 0
