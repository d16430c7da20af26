#!/usr/bin/env bash
# The published case: 15 modes, 21 tested cuts, spectral radii computed by independent code.
. "$SOURCE/apps/testing.sh"

columns=$(jq -R -s -c 'split("\n")[1:] | map(select(length > 0) | split(",") | {sdm: .[3] | tonumber, spectral: .[4] | tonumber})' \
  "$data/thesis-table-6-3.csv")
for method in sdm spectral; do
  sdm-lobes "$data/thesis-table-6-2.json" --cut "$data/thesis-cut.json" --points "$data/thesis-table-6-3.csv" \
    --method $method --speed 9000:9000:1 --depth 1:1:1 -o $method.json
  check "$method runs" test $? -eq 0
  check_jq "$method: 21 radii within 1e-7 of the published column" $method.json \
    '[.points, $t] | transpose | length == 21 and all((.[0].spectral_radius - .[1][$m]) | fabs < 1e-7)' \
    --argjson t "$columns" --arg m $method
done
misses='[.points[] | select(.agrees | not) | [.depth_mm, .speed_rpm]] | sort'
check_jq "sdm misses the two cuts that the thesis names" sdm.json "$misses == [[1,9000],[2,15000]]"
check_jq "the converged method misses (1.5 mm, 15000 rpm) too" spectral.json \
  "$misses == [[1,9000],[1.5,15000],[2,15000]]"
check_jq "sdm says how far it is from convergence" sdm.json '.convergence > 1e-4'
check_jq "spectral says that it has converged" spectral.json '.convergence < 1e-7'

sdm-lobes "$data/thesis-table-6-2.json" --cut "$data/thesis-cut.json" --points "$data/thesis-table-6-3.csv" \
  --modes 1-7,14-15 --method sdm --speed 9000:9000:1 --depth 1:1:1 -o few.json
check_jq "modes 1-7 and 14-15 alone give all verdicts" few.json "$misses == [[1,9000],[2,15000]]"
