#!/usr/bin/env bash
# Modal tables instead of a fit: compared, and tracked from pose to pose for sdm-lobes.
. "$SOURCE/apps/testing.sh"
table=$data/thesis-table-6-2.json
fit-modes --synthesize 2:1000:3993 --noise-db 40 "$table" | fit-modes --quiet -o fit.json

# A fit against the truth: every mode found, its differences as large as its deviations.
fit-modes --compare "$table" fit.json -o compared.json
check_jq "all modes are paired with themselves" compared.json '.format == "stablecut/mode-comparison/1" and .dofs == ["x", "y"]
  and ([.pairs[] | [.first, .second]] == [range(15) | [. + 1, . + 1]]) and .first_alone == [] and .second_alone == []
  and all(.pairs[]; .mac > 0.999)'
check_jq "differences lie within four deviations" compared.json 'all(.pairs[]; (.frequency_difference_hz | fabs) < 4 * .frequency_difference_std_hz
  and (.damping_ratio_difference | fabs) < 4 * .damping_ratio_difference_std) and (.pairs | length) == 15'
check_jq "a difference is the other's less this one's" compared.json '. as $c | .pairs[3]
  | .frequency_difference_hz == ($c.second[.second - 1].frequency_hz - $c.first[.first - 1].frequency_hz)'
check_jq "assurance criteria: a row for each mode of the first" compared.json '(.mac | length == 15) and all(.mac[]; length == 15)'
check_jq "that of mode 2 with mode 5 by hand" compared.json '.mac[1][4] as $mac | [$t[0].modes[4], $f[0].modes[1]] | map(.psi_r) as [$b, $a]
  | ([range(2) | $a[.][0] * $b[.][0] + $a[.][1] * $b[.][1]] | add) as $re
  | ([range(2) | $a[.][0] * $b[.][1] - $a[.][1] * $b[.][0]] | add) as $im
  | (($re * $re + $im * $im) / (([$a[][]] | map(. * .) | add) * ([$b[][]] | map(. * .) | add)) - $mac | fabs) < 1e-12' \
  --slurpfile t "$table" --slurpfile f fit.json
check_jq "complexity lies between 0 and 1" fit.json '[.modes[] | select(.out_of_band | not)] | length > 0 and all(.phase_collinearity >= 0 and .phase_collinearity <= 1
  and .complexity >= 0 and .complexity <= 1)'
jq '.modes |= map(.psi_r = [[1e-3, -1e-3], [2e-3, -2e-3]] | .psi_l = .psi_r)' "$table" >real.json
fit-modes --synthesize 2:1000:3993 real.json | fit-modes --quiet --modes 15 -o real-fit.json
check_jq "real modes of a fit have one phase" real-fit.json '[.modes[] | select(.out_of_band | not)] | length > 10 and all(.phase_collinearity > 1 - 1e-9 and .complexity < 1e-4)'

# Tracked: another pose has its modes in another order, one is lost and one is new.
jq '.modes |= (map(.frequency_hz *= 1.02) | reverse | del(.[3]))
  | .modes += [.modes[0] | .frequency_hz = 4000]' "$table" >pose2.json
fit-modes --track "$table" pose2.json -o labelled.json
check_jq "a mode keeps its number in the first table, the new one gets another" labelled.json '([.modes[:14][].label] == ([range(15; 0; -1) | "m\(.)"] | del(.[3])))
  and .modes[14].label == "m16"'
check_jq "nothing else changes" labelled.json '(del(.provenance) | .modes |= map(del(.label))) == $t[0]' --slurpfile t pose2.json
fit-modes --track labelled.json fit.json -o back.json
check_jq "and back" back.json '[.modes[:11][].label] == [range(1; 12) | "m\(.)"] and .modes[11].label == "m17" and .modes[12].label == "m13"'

# For sdm-lobes.
sdm-lobes labelled.json --cut "$data/thesis-cut.json" --speed 9000:12000:3 --depth 0:2:4 --per-mode -o lobes.json
check_jq "lobes say the labels" lobes.json 'all(.limit[] | select(.depth_mm); .mode_label == $t[0].modes[.mode - 1].label) and ([.limit[] | select(.depth_mm)] | length > 0)
  and all(.per_mode[]; .mode_label == $t[0].modes[.mode - 1].label)' --slurpfile t labelled.json
sdm-lobes labelled.json --cut "$data/thesis-cut.json" --speed 9000:12000:3 --depth 0:2:4 --modes m15,m2 --no-provenance -o by-label.json
sdm-lobes labelled.json --cut "$data/thesis-cut.json" --speed 9000:12000:3 --depth 0:2:4 --modes 1,13 --no-provenance -o by-number.json
check "modes by labels" cmp by-label.json by-number.json
refused 64 '^sdm-lobes: --modes: m99: expected labels of modes of labelled.json' sdm-lobes labelled.json --cut "$data/thesis-cut.json" --modes m99

refused 64 '^fit-modes: --track: expected without --compare' fit-modes --compare a --track b c
refused 64 '^fit-modes: --band: expected with a measurement' fit-modes --compare a --band 1:2 c
refused 64 '^fit-modes: --compare, --track: expected without' fit-modes --compare a --convert c
refused 64 '^fit-modes: -: expected standard input for one input only' fit-modes --compare - - <"$table"
refused 66 '^fit-modes: nowhere.json: cannot be read' fit-modes --compare nowhere.json "$table"
jq '.dofs = ["u", "v"]' "$table" >elsewhere.json
refused 65 '^fit-modes: elsewhere.json: /dofs: no direction in common' fit-modes --compare elsewhere.json "$table"
jq '.modes[0].label = "a" | .modes[1].label = "a"' "$table" >twice.json
refused 65 '^fit-modes: twice.json: /modes/1/label: "a": expected a name, each once' fit-modes --compare twice.json "$table"
