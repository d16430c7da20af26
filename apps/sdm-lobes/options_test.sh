#!/usr/bin/env bash
# Options of sdm-lobes: each does what it says, and what should not change the result does not.
. "$SOURCE/apps/testing.sh"
table=$data/thesis-table-6-2.json cut=$data/thesis-cut.json
small=(--speed 8000:20000:7 --depth 0:3:9)

same_for_every_tool sdm-lobes lobes --cut "$cut"

sdm-lobes "$table" --cut "$cut" "${small[@]}" -o one.json --threads 1
sdm-lobes --cut "$cut" "${small[@]}" -o two.json --threads 2 <"$table"
check_jq "grid is [depth][speed]" one.json '(.spectral_radius | length == 9) and (.spectral_radius[0] | length == 7)'
check_jq "limit has a row per speed" one.json '[.limit[].speed_rpm] == .speed_rpm'
check_jq "limit agrees with the grid" one.json '. as $d | [range(7)] | all(. as $s
  | ($d.limit[$s].depth_mm // 99) as $limit | [range(9)] | all(($d.depth_mm[.] < $limit) == ($d.spectral_radius[.][$s] <= 1)
    or $d.depth_mm[.] > $limit))'
check "same bytes with 1 and 2 threads" cmp <(jq 'del(.provenance)' one.json) <(jq 'del(.provenance)' two.json)
check_jq "provenance: tool, hash, result arguments only" one.json '.provenance | .tool == "sdm-lobes"
  and (.inputs | length == 2) and (.inputs[1].sha256 == $sha) and (.arguments | index("--threads") == null)
  and (.arguments | index("--speed") != null)' --arg sha "$(sha256sum "$table" | cut -d' ' -f1)"
sdm-lobes "$table" --cut "$cut" "${small[@]}" --no-provenance -o plain.json
check_jq "no provenance on request" plain.json 'has("provenance") | not'

sdm-lobes "$table" --cut "$cut" "${small[@]}" --limit-only -o limit.json
check_jq "limit only: no grid" limit.json 'has("spectral_radius") | not'
check_jq "limit only: the same limit" limit.json '[.limit, $one[0].limit] | transpose
  | all(((.[0].depth_mm // 0) - (.[1].depth_mm // 0)) | fabs < 1e-6)' --slurpfile one one.json

sdm-lobes "$table" --teeth 2 --kt 689 --kr 267 --milling up --immersion 0.25 "${small[@]}" -o options.json
check "a cut by options is the cut by document" cmp <(jq .spectral_radius one.json) <(jq .spectral_radius options.json)
jq 'del(.milling, .radial_immersion) | .entry_deg = 0 | .exit_deg = 60' "$cut" >angles.json
sdm-lobes "$table" --cut angles.json "${small[@]}" -o angles-out.json
check_jq "a cut by angles is the cut by immersion" angles-out.json '[.spectral_radius, $one[0].spectral_radius]
  | map(flatten) | transpose | all((.[0] - .[1]) | fabs < 1e-9)' --slurpfile one one.json
jq '.feed_angle_deg = 360' "$cut" >turned.json
sdm-lobes "$table" --cut turned.json "${small[@]}" -o turned-out.json
check_jq "a full turn of the feed changes nothing" turned-out.json '[.spectral_radius, $one[0].spectral_radius]
  | map(flatten) | transpose | all((.[0] - .[1]) | fabs < 1e-9)' --slurpfile one one.json

sdm-lobes "$table" --cut "$cut" --speed 9000:12000:3 --depth 0:3:5 --modes 14,15 --per-mode -o modes.json
check_jq "per mode: a limit curve each" modes.json '[.per_mode[].mode] == [14, 15] and all(.per_mode[].limit; length == 3)'
sdm-lobes "$table" --cut "$cut" --speed 9000:12000:3 --depth 0:3:5 --modes 15 -o alone.json
check_jq "per mode: the limit of that mode alone" modes.json '[.per_mode[1].limit, $alone[0].limit] | transpose
  | all(((.[0].depth_mm // 0) - (.[1].depth_mm // 0)) | fabs < 1e-6)' --slurpfile alone alone.json

jq 'del(.chart)' "$cut" >nochart.json
sdm-lobes "$table" --cut nochart.json --modes 15 -o default.json
check_jq "64 by 64 when nothing says the chart" default.json '(.speed_rpm | length == 64) and (.depth_mm | length == 64)'

echo '[{"depth_mm": 1, "speed_rpm": 20000}, {"depth_mm": 2, "speed_rpm": 5000, "observed": "chatter"}]' >points.json
sdm-lobes "$table" --cut "$cut" --speed 9000:9000:1 --depth 1:1:1 --points points.json -o judged.json
check_jq "points from JSON" judged.json '.points[0].stable and (.points[0] | has("agrees") | not) and .points[1].agrees'

jq '.dofs = ["x"] | .modes |= map(.psi_r |= .[:1] | .psi_l |= .[:1])' "$table" >x.json
sdm-lobes x.json --cut "$cut" "${small[@]}" -o x-out.json
check "one direction runs" test $? -eq 0
jq '.modes |= map(.psi_r[1] = [0, 0] | .psi_l[1] = [0, 0])' "$table" >x-rigid-y.json
sdm-lobes x-rigid-y.json --cut "$cut" "${small[@]}" -o x-rigid-y-out.json
check_jq "one direction is two with the other rigid" x-out.json '[.spectral_radius, $two[0].spectral_radius]
  | map(flatten) | transpose | all((.[0] - .[1]) | fabs < 1e-9)' --slurpfile two x-rigid-y-out.json

sdm-lobes "$table" --cut "$cut" "${small[@]}" | head -c 100 >/dev/null
status=("${PIPESTATUS[@]}")
check "a reader that leaves early ends the tool quietly" test "${status[0]}" -eq 141 -o "${status[0]}" -eq 0
