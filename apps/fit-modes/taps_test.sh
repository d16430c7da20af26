#!/usr/bin/env bash
# Records of hits: simulated ones (simulate_taps.py) with noise on the force and a double hit among them, in every form;
# and a real one, where it is beside the checkout.
. "$SOURCE/apps/testing.sh"
/usr/bin/python3 "$SOURCE/apps/fit-modes/simulate_taps.py" "$scratch" || exit 1
err=$scratch/err

# modes_of FILE FACTOR: the table holds 60 Hz, 4 % and 210 Hz, 2 %, each within FACTOR of its deviations and within 1e-3.
modes_of() {
  jq -e --argjson factor "$2" '[.modes[] | select(.out_of_band | not)] as $m | ($m | length == 2) and
    ([[$m[0], 60, 0.04], [$m[1], 210, 0.02]] | all(. as [$mode, $hz, $damping]
      | ($mode.frequency_hz - $hz | fabs) < ([$factor * $mode.std.frequency_hz, 1e-3 * $hz] | min)
      and ($mode.damping_ratio - $damping | fabs) < ([$factor * $mode.std.damping_ratio, 0.02 * $damping] | min)))' "$1" >/dev/null
}

fit-modes --taps x=x.csv -o modes.json 2>"$err"
check "ten hits with noise: fits" test $? -eq 0
check "the modes" modes_of modes.json 4
check "the double hit is named" grep -q '^fit-modes: warning: x.csv: hit 5 along x, at 4.06[12] s: a double hit, the other blow 1[67].* ms apart: left out$' "$err"
check "and no other" test "$(grep -c 'left out$' "$err")" -eq 1

# As a document: variance, covariance, coherence, averages; the same numbers from every form.
fit-modes --taps x=x.csv --convert --tap-window none --no-provenance -o frf.json 2>.err
check_jq "an accelerance of seven hits" frf.json '.quantity == "accelerance" and ([.h[] | .response + .reference] == ["xx", "yx"])
  and all(.h[]; .averages == 7 and (.variance | length) == (.re | length) and (.coherence | length) == (.re | length))
  and (.covariances | length == 1 and .[0].response == "y" and .[0].other == "x" and .[0].reference == "x")
  and (has("window_decay_per_s") | not)'
check_jq "a covariance is no larger than the deviations allow" frf.json '[.covariances[0].re, .covariances[0].im, .h[0].variance, .h[1].variance]
  | transpose | all(pow(.[0]; 2) + pow(.[1]; 2) <= 1.000001 * .[2] * .[3])'
fit-modes --convert --no-provenance frf.json -o again.json
check "a document with covariances reads back" cmp frf.json again.json
fit-modes --taps x=volts.csv --convert --tap-window none --no-provenance --sensitivity force=2.25mV/N --sensitivity response=100mV/g -o volts.json 2>"$err"
near='[.h, $r[0].h] | transpose | all(([.[0].re + .[0].im, .[1].re + .[1].im] | transpose | map(. as [$a, $b] | $a - $b | fabs) | max)
  <= 1e-6 * (.[1].re + .[1].im | map(fabs) | max))'
check_jq "volts by sensitivities" volts.json "$near" --slurpfile r frf.json
fit-modes --taps x=x.uff --convert --tap-window none --no-provenance -o uff.json 2>"$err"
check_jq "a universal file" uff.json "$near" --slurpfile r frf.json
fit-modes --taps x=hit1.csv,hit2.csv,hit3.csv --taps x=hit4.csv,hit5.csv,hit6.csv --taps x=hit7.csv,hit8.csv -o single.json 2>"$err"
check "one file each" modes_of single.json 4
check "its double hit" grep -q '^fit-modes: warning: hit5.csv: hit 5 along x, .*double hit' "$err"
fit-modes --taps -x=x.csv --convert --tap-window none --no-provenance -o turned.json 2>.err
jq '.h[] |= (.re |= map(-.) | .im |= map(-.))' turned.json >back.json
# An even number of samples has two medians, and the offset is one of them.
check_jq "a hammer against the axis" back.json "${near/1e-6/1e-5}" --slurpfile r frf.json
fit-modes --taps x=x.csv --taps y=x.csv --convert --tap-window none --no-provenance -o four.json 2>.err
check_jq "two directions of the force make a 2x2" four.json '([.h[] | .response + .reference] == ["xx", "yx", "xy", "yy"])
  and .h[:2] == $r[0].h and .h[2].re == .h[0].re and ([.covariances[].reference] == ["x", "y"])' --slurpfile r frf.json
for estimator in H2 Hv; do
  fit-modes --taps x=x.csv --estimator $estimator -o other.json 2>.err
  check "$estimator" modes_of other.json 5
done

# An exponential window: its damping is off the modes, and the document says that it was there.
fit-modes --taps x=exact.csv --tap-window 20 -o windowed.json 2>.err
check_jq "without noise the damping is right through a window" windowed.json '[.modes[] | select(.out_of_band | not)] | length == 2
  and (.[0].damping_ratio / 0.04 - 1 | fabs < 1e-5) and (.[1].damping_ratio / 0.02 - 1 | fabs < 1e-5)
  and (.[0].frequency_hz / 60 - 1 | fabs < 1e-6) and (.[1].frequency_hz / 210 - 1 | fabs < 1e-6)'
fit-modes --taps x=exact.csv --tap-window 0.05s --convert -o window.json 2>.err
check_jq "the document says the decay" window.json '.window_decay_per_s == 20'
fit-modes window.json --no-provenance -o by-document.json 2>.err
check_jq "and gives the same modes" by-document.json '[.modes, $r[0].modes] | transpose | all(.[0].damping_ratio / .[1].damping_ratio - 1 | fabs < 1e-6)' --slurpfile r windowed.json
refused 64 '^fit-modes: --window-decay: expected with a measurement that has no window' fit-modes --quiet --window-decay 3 window.json
refused 64 '^fit-modes: --to: a universal file cannot tell' fit-modes --quiet --convert --to uff window.json
jq '.h = [.h[0]] | del(.covariances)' window.json >tip.json
refused 65 '^rcsa-couple: tip.json: /window_decay_per_s: 20: expected responses without' rcsa-couple --quiet --identify tip.json "$data/carbide-in-collet.json"

# What is chosen does what it says.
fit-modes --taps x=x.csv --convert --tap-length 0.5 --tap-window none -o half.json 2>.err
check_jq "half the length, lines twice as far apart" half.json '.frequency_hz[0] == 2'
fit-modes --taps x=x.csv --convert --trigger 75 --tap-window none -o strong.json 2>.err
check_jq "a trigger leaves weak hits out" strong.json '.h[0].averages == 6'
fit-modes --taps x=x.csv --convert --sample-rate 8192 --tap-window none -o fast.json 2>.err
check_jq "a rate wins over the times" fast.json '[.frequency_hz, $r[0].frequency_hz] | transpose | length > 100 and all((.[0] / .[1] - 2 | fabs) < 1e-2)' --slurpfile r frf.json
fit-modes --taps x=x.csv --convert --band 50:300 --tap-window none -o band.json 2>.err
check_jq "a band" band.json '.frequency_hz[0] >= 50 and .frequency_hz[-1] <= 300'
fit-modes --taps x=x.csv --convert --pre-trigger 0.02 --force-window pulse --tap-window none -o window.json 2>.err
check_jq "a force window and a time before it change the numbers" window.json '.h[0].re[5] != $r[0].h[0].re[5]' --slurpfile r frf.json

# A record over the time is never read as frequencies.
refused 65 '^fit-modes: x.csv: line 1: "time \(s\)": a time: expected frequencies, .*\(--taps\)$' fit-modes x.csv
tail -n +2 x.csv | cut -d, -f1-3 >bare.csv
refused 65 '^fit-modes: bare.csv: line 1: a first column in steps of 0.000244: a time: .*\(--taps\)$' fit-modes bare.csv
refused 65 '^fit-modes: x.uff: line 8 .*function type 1, a time response: expected type 4' fit-modes x.uff

refused 1 '^fit-modes: .*force along x: no hit that can be used$' fit-modes --quiet --taps x=hit5.csv
refused 65 '^fit-modes: volts.csv: line 1: V: expected a sensitivity in volts \(--sensitivity\)$' fit-modes --quiet --taps x=volts.csv
cut -d, -f2- x.csv >untimed.csv
refused 65 '^fit-modes: untimed.csv: line 1: expected a column of times \(--sample-rate\)$' fit-modes --quiet --taps x=untimed.csv
fit-modes --quiet --convert --tap-window none --taps x=x.csv --no-provenance -o timed.json
fit-modes --quiet --convert --tap-window none --taps x=untimed.csv --sample-rate 4096 --no-provenance -o rate.json
check "a rate instead of times" cmp timed.json rate.json
refused 64 '^fit-modes: --taps: x.csv: expected DIRECTION=FILE' fit-modes --taps x.csv
refused 64 '^fit-modes: --taps: x=a,,b: expected files between commas' fit-modes --taps x=a,,b
refused 64 '^fit-modes: --sensitivity: force=2: expected' fit-modes --taps x=x.csv --sensitivity force=2
refused 64 '^fit-modes: --tap-window: soon: expected auto, none' fit-modes --taps x=x.csv --tap-window soon
refused 64 '^fit-modes: --sample-rate: 0: expected' fit-modes --taps x=x.csv --sample-rate 0
refused 64 '^fit-modes: --trigger: expected with --taps' fit-modes --trigger 3 x.csv
refused 64 '^fit-modes: --node: expected without --taps' fit-modes --node 3 --taps x=x.uff
refused 64 '^fit-modes: --taps: expected without --synthesize' fit-modes --taps x=x.csv --synthesize 1:2:2
refused 64 '^fit-modes: x.csv: expected no other input with --taps' fit-modes --taps x=x.csv x.csv
refused 66 '^fit-modes: nowhere.csv: cannot be read' fit-modes --taps x=nowhere.csv
refused 65 '^fit-modes: frf.json: a JSON document: expected columns or a universal file' fit-modes --taps x=frf.json

hit=$SOURCE/../shared/real/raw-hit/hit.txt.gz
if [ -f "$hit" ]; then
  zcat "$hit" >hit.txt
  refused 65 '^fit-modes: hit.txt: line 1: a first column in steps of 1.95e-05: a time' fit-modes hit.txt
  fit-modes --taps x=hit.txt --band 100:3500 -o hit.json 2>"$err"
  check "a real hit gives modes" test $? -eq 0
  check "that explain it" jq -e '.fit.relative_error < 0.05' hit.json >/dev/null
  check "what is assumed is said" grep -q 'taken as accelerations' "$err"
else
  echo "the real hit is not here: not checked"
fi
