#!/usr/bin/env bash
# The chain: a noisy tap test in, the verdicts of the noise-free table out.
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
