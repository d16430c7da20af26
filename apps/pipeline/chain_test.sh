#!/usr/bin/env bash
# The chains: a noisy tap test in, the verdicts of the noise-free table out; load samples in, the stiffest pose out; an assembly in,
# its lobes out.
. "$SOURCE/apps/testing.sh"
table=$data/thesis-table-6-2.json
lobes=(sdm-lobes --cut "$data/thesis-cut.json" --points "$data/thesis-table-6-3.csv" --speed 9000:9000:1 --depth 1:1:1)
"${lobes[@]}" "$table" -o exact.json
for seed in 1 2 3; do
  fit-modes --synthesize 2:1000:3993 --noise-db 40 --seed $seed "$table" | fit-modes | "${lobes[@]}" -o noisy.json
  check_jq "seed $seed: the same verdict wherever the radius is farther than 2e-4 from 1" noisy.json '[.points, $exact[0].points]
    | transpose | length == 21 and all(.[0].stable == .[1].stable or ((.[1].spectral_radius - 1) | fabs) <= 2e-4)' \
    --slurpfile exact exact.json
done
check_jq "provenance reaches back through the pipe" noisy.json '[.provenance.inputs[] | select(.from) | .from.tool,
  (.from.inputs[] | select(.from) | .from.tool, (.from.inputs[].sha256))] == ["fit-modes", "fit-modes", $sha]' \
  --arg sha "$(sha256sum "$table" | cut -d' ' -f1)"

robot=$data/kr360.json
joint-stiffness --robot "$robot" "$data/kr360-loads.csv" |
  best-pose --robot "$robot" --height 1600 --index deflection --force 0,0,-588.6 --limit-margin 0 --quiet -o pose.json
check_jq "the stiffest pose from noisy samples, within three of its deviations" pose.json '.best |
  .score_std > 0 and (.score - 197.3 | fabs) < 3 * .score_std and (.joints_deg[1] + 130 | fabs) < 1e-6'
check_jq "provenance of samples and robot" pose.json '[.provenance.inputs[] | .name, (.from // {} | .inputs // [] | .[].name)] | length == 4'

rcsa-couple "$data/liu-assembly.json" | fit-modes --quiet | sdm-lobes --cut "$data/thesis-cut.json" --depth 0:0.2:8 --speed 9000:12000:4 -o tool.json
check_jq "lobes of a tool that nobody tapped: it chatters at its first mode, 294 Hz" tool.json '
  [.limit[] | select(.depth_mm) | .chatter_frequency_hz] | length >= 2 and all(. > 285 and . < 300)'

cut-force --identify "$data/slot-forces.csv" "$data/slotting-tool.json" | sdm-lobes --cut - "$table" --speed 9000:12000:4 --depth 0:2:5 --samples 20 -o drawn.json
check_jq "coefficients from a dynamometer to the probability of stability" drawn.json '[.probability_stable | flatten[] | select(. > 0 and . < 1)] | length > 0'
check_jq "provenance reaches the forces" drawn.json '[.provenance.inputs[] | select(.from) | .from.inputs[].name] | any(endswith("slot-forces.csv"))'
