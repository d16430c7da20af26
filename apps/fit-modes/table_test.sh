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
check_jq "--fitted is what --synthesize makes of the table, to the last bit" rebuilt.json '.h == $f[0].h' --slurpfile f fitted.json
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

# How sure: standard deviations and covariance of every number, in the same order.
check_jq "deviations of all numbers" fit-1.json 'all(.modes[]; (.std.psi_r | length == 2) and (.std.psi_l | flatten | length == 4 and all(. > 0)))'
check_jq "covariance of all numbers" fit-1.json '.fit.covariance as $c | ($c.parameters | length == 150) and ($c.matrix | length == 150)
  and ($c.parameters[:4] == ["/modes/0/frequency_hz", "/modes/0/damping_ratio", "/modes/0/psi_r/0/re", "/modes/0/psi_r/0/im"])
  and ($c.parameters[-1] == "/modes/14/psi_l/1/im")'
check_jq "the diagonal is the square of the deviations" fit-1.json '. as $d | .fit.covariance | [.parameters, [range(.matrix | length) as $i | .matrix[$i][$i]]]
  | transpose | all(. as $p | ($p[0] | split("/")[1:] | .[1] |= tonumber) as $path | $path[:2] as $mode | $path[2:] as $rest
  | ($d | getpath($mode) | .std) as $std
  | (if ($rest | length) == 1 then $std[$rest[0]] else $std[$rest[0]][$rest[1] | tonumber][if $rest[2] == "re" then 0 else 1 end] end) as $s
  | ($p[1] - $s * $s | fabs) <= 1e-12 * $p[1])'

# Models: the published table is not reciprocal by far; one that is, is recognised.
fit-modes --synthesize 2:1000:1500 --noise-db 40 --no-variance "$table" | fit-modes --model best -o best.json
check_jq "the published table is not symmetric" best.json '.fit.model == "nonsymmetric" and (.fit.non_reciprocity.index > 20 * .fit.non_reciprocity.of_noise)
  and ([.fit.criterion.models[] | .model] == ["nonsymmetric", "symmetric", "proportional"]) and (.fit.criterion.models | min_by(.bic).model == "nonsymmetric")'
jq '.modes |= map(.psi_l = (.psi_r | map([.[1] * 1e-3, -.[0] * 1e-3])))' "$table" | fit-modes --synthesize 2:1000:1500 --noise-db 40 --no-variance -o symmetric-tap.json
fit-modes --model best symmetric-tap.json -o symmetric.json
check_jq "a symmetric one is" symmetric.json '.fit.model == "symmetric" and (.fit.non_reciprocity | .index < 1.3 * .of_noise) and all(.modes[]; .psi_r == .psi_l)'
fit-modes --model symmetric symmetric-tap.json -o named.json
check_jq "or by name" named.json '.fit.model == "symmetric" and (.modes | length) == $n' --argjson n "$(jq '.modes | length' symmetric.json)"
fit-modes --quiet --model proportional "$table" 2>.err </dev/null; check "a table is no measurement" grep -q '/format' .err
jq '.modes |= map((.psi_r | map([.[0] * 1e-2, -.[0] * 1e-2])) as $psi | .psi_r = $psi | .psi_l = $psi)' "$table" |
  fit-modes --synthesize 2:1000:1500 --noise-db 40 --no-variance -o proportional-tap.json
fit-modes --quiet --model best proportional-tap.json -o proportional.json
check_jq "proportional modes have one phase" proportional.json '.fit.model == "proportional" and all(.modes[]; .psi_r == .psi_l and
  (. as $m | $m.psi_r[0] as $a | $m.psi_r[1] as $b | ($a[0] * $b[1] - $a[1] * $b[0] | fabs) < 1e-9 * (($a + $b) | map(fabs) | max | . * .)))'
refused 64 '^fit-modes: --model: ' fit-modes --model good symmetric-tap.json

# The stabilization diagram.
fit-modes --synthesize 2:1000:1500 --noise-db 40 "$table" | fit-modes --stabilization diagram.json -o chosen.json
check_jq "orders 3 to 40, the chosen modes, the indicator" diagram.json '([.orders[].pole_pairs] == [range(3; 41)]) and (.modes | length == 15)
  and (.singular_values_m_per_n | length == 2 and all(.[]; length == 1500))'
check_jq "every chosen mode is a stable pole of most high orders" diagram.json '[.orders[20:][].poles] as $o | all(.modes[]; .frequency_hz as $f
  | [$o[] | any(.[]; .stable == "pole" and ((.frequency_hz / $f - 1) | fabs) < 0.01)] | map(select(.)) | length >= 13)'
