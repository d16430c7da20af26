#!/usr/bin/env bash
# fit-modes on the published table: found without a hint, at the precision that the noise allows.
. "$SOURCE/apps/testing.sh"
table=$data/thesis-table-6-2.json

same_for_every_tool fit-modes modal-table
refused 66 '^fit-modes: missing.json: cannot be read' fit-modes --synthesize 1:2:2 missing.json

good=0
for seed in 1 2 3 4 5 6 7 8 9 10; do
  fit-modes --synthesize 2:1000:3993 --noise-db 40 --seed $seed "$table" | fit-modes --threads 1 -o fit-$seed.json
  # Every mode within 4 of its standard deviations, which are the Cramer-Rao bound (checked in lib/modal).
  [ "$(jq --slurpfile truth "$table" '(.modes | length == 15) and ([.modes, $truth[0].modes] | transpose | all(
    ((.[0].frequency_hz - .[1].frequency_hz) | fabs) < 4 * .[0].std.frequency_hz and
    ((.[0].damping_ratio - .[1].damping_ratio) | fabs) < 4 * .[0].std.damping_ratio))' fit-$seed.json)" = true ] && good=$((good + 1))
done
check "15 modes within 4 standard deviations on $good of 10 seeds" test $good -ge 9
check_jq "the bound itself: 3.5e-6 (mode 13) to 2e-4 (mode 11) of the frequency" fit-1.json '[.modes[] | .std.frequency_hz / .frequency_hz]
  | (min_by(.) > 3.2e-6) and (min_by(.) < 4e-6) and (index(min) == 12) and (max_by(.) > 1.8e-4) and (max_by(.) < 2.2e-4) and (index(max) == 10)'
check_jq "noise was given, and is all that is left" fit-1.json '.fit.noise == "given" and .fit.stopped_by == "noise"
  and (.fit.reduced_chi_square > 0.97) and (.fit.reduced_chi_square < 1.02)'

fit-modes --synthesize 2:1000:3993 "$table" -o exact.json
check_jq "no noise, no variance" exact.json '(.h | length == 4) and all(.h[]; has("variance") | not)'
fit-modes exact.json -o again.json --fitted fitted.json
check_jq "exact data give the table back" again.json '[.modes, $truth[0].modes] | transpose | all(
  ((.[0].frequency_hz / .[1].frequency_hz - 1) | fabs < 1e-9) and ((.[0].damping_ratio / .[1].damping_ratio - 1) | fabs < 1e-7))' \
  --slurpfile truth "$table"
check_jq "vectors of equal norm, equal phase at psi_r's largest component, real part positive" again.json '
  def size: map(.[0] * .[0] + .[1] * .[1]); def norm: size | add | sqrt;
  all(.modes[]; . as $m | (($m.psi_r | norm) / ($m.psi_l | norm) - 1 | fabs < 1e-9)
    and ($m.psi_r | size | index(max)) as $i | ($m.psi_r[$i] as $r | $m.psi_l[$i] as $l
      | (($r[0] * $l[1] - $r[1] * $l[0]) | fabs < 1e-9 * ($m.psi_r | norm) * ($m.psi_r | norm)) and $r[0] > 0))'
fit-modes --synthesize 2:1000:3993 again.json -o rebuilt.json
check_jq "--fitted is what --synthesize makes of the table" rebuilt.json '[.h, $f[0].h] | transpose | all(
  [.[0].re, .[1].re] | transpose | all(((.[0] - .[1]) | fabs) <= 1e-12 * ((.[1] | fabs) + 1e-9)))' --slurpfile f fitted.json
check_jq "the table rebuilds the measurement" again.json '.fit.relative_error < 1e-9'

jq '.quantity = "accelerance" | .frequency_hz as $f | def accelerate: [., $f] | transpose | map(- .[0] * pow(6.283185307179586 * .[1]; 2));
  .h |= map(.re |= accelerate | .im |= accelerate)' exact.json >accelerance.json
fit-modes accelerance.json -o converted.json
check_jq "accelerance is converted" converted.json '[.modes, $again[0].modes] | transpose | length == 15 and all(
  ((.[0].frequency_hz / .[1].frequency_hz - 1) | fabs < 1e-7))' --slurpfile again again.json
jq '.h |= map(if .response == "y" then .response = "-y" | .re |= map(-.) | .im |= map(-.) else . end)' exact.json >signed.json
fit-modes signed.json -o signed-fit.json
check_jq "a sign in a direction's name turns the entry" signed-fit.json '[.modes, $again[0].modes] | transpose | length == 15 and all(
  ((.[0].psi_r[1][0] - .[1].psi_r[1][0]) | fabs < 1e-7))' --slurpfile again again.json

jq -r '.frequency_hz as $f | "f_hz,xx_re,xx_im,xy_re,xy_im,yx_re,yx_im,yy_re,yy_im", ([range($f | length) as $i
  | [$f[$i], (.h[] | .re[$i], .im[$i])] | @csv] | .[])' exact.json >exact.csv
fit-modes exact.csv -o from-csv.json
check_jq "CSV gives the same modes" from-csv.json '[.modes, $again[0].modes] | transpose | length == 15 and all(
  ((.[0].frequency_hz / .[1].frequency_hz - 1) | fabs < 1e-7))' --slurpfile again again.json
fit-modes exact.json --no-provenance -o a.json; fit-modes --threads 1 --no-provenance -o b.json <exact.json
check "same bytes again, and with one thread" cmp a.json b.json
