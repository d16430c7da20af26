#!/usr/bin/env bash
# best-pose --cut: what the options do in searches, evaluations and paths. What the numbers are: cut_test.py.
. "$SOURCE/apps/testing.sh"
robot=$data/kr360.json
jq '{format: "stablecut/joint-stiffness/1", stiffness_n_m_per_rad: .k_theta_2d_n_m_per_rad}' "$data/yanshan-poses.json" >k2d.json
jq -n '{format: "stablecut/cut/1", teeth: 4, kt_n_per_mm2: 1930, kr_n_per_mm2: 1160, ka_n_per_mm2: 200, kte_n_per_mm: 5, milling: "up",
  radial_immersion: 0.3, diameter_mm: 16, helix_deg: 45, feed_per_tooth_mm: 0.18}' >cut.json
run() { best-pose --robot "$robot" --quiet --cut cut.json --cut-depth 1 "$@"; }
plane=(--height 1200 --x 600:1600:11 --y -500:500:11)

run "${plane[@]}" --feed 0,1,0 k2d.json -o surface.json --map map.json
check_jq "the wall counts by default" surface.json '.index == {name: "surface", unit: "um"} and (.best.score / .best.cut.largest_um[1] - 1 | fabs < 1e-9) and
  .cut.walls == ["left"] and .cut.depth_mm == 1 and (.provenance.arguments | index("--cut-depth") and index("--feed") and (index("--cut") | not)) and
  ([.provenance.inputs[].name] | .[1:] == ["k2d.json", "cut.json"])'
check_jq "the map is of the same" map.json '.index.name == "surface" and ([.score[][] | select(.)] | length > 50 and min >= $b[0].best.score * (1 - 1e-9))' --slurpfile b surface.json
check_jq "a feed is not free to turn with the base" surface.json '[.families[].kind] | index("base-turn") == null and index("tool-turn") != null'
check_jq "under the mean force the pose yields by its deflection" surface.json '.best | (.cut.mean_um | map(. * .) | add | sqrt) / .deflection_um - 1 | fabs < 1e-9'
run "${plane[@]}" --feed 0,5,7 k2d.json --no-provenance -o across.json
check_jq "what of a feed runs along the tool axis does not count, nor its length" across.json '(.best.score / $b[0].best.score - 1 | fabs) < 1e-9 and (.best.cut.feed[2] | fabs) < 1e-12' --slurpfile b surface.json
run "${plane[@]}" --feed 0,1,0 --threads 1 k2d.json -o one.json
check "same bytes on one thread" cmp -s surface.json one.json
jq '.milling = "down"' cut.json >down.json
best-pose --robot "$robot" --quiet --cut down.json --cut-depth 1 "${plane[@]}" --feed 0,1,0 k2d.json -o down-best.json
check_jq "down milling leaves the wall on the right" down-best.json '.cut.walls == ["right"] and .best.cut.walls[0].mean_error_um == .best.cut.mean_um[1]'
run "${plane[@]}" --feed 0,1,0 --index feed k2d.json -o feed.json
check_jq "the index feed" feed.json '(.best.score / .best.cut.largest_um[0] - 1 | fabs < 1e-9) and .best.score <= $b[0].best.cut.largest_um[0] and .best.cut.largest_um[1] >= $b[0].best.score * (1 - 1e-6)' --slurpfile b surface.json
run "${plane[@]}" --feed 0,1,0 --index weakest k2d.json -o weakest.json
best-pose --robot "$robot" --quiet "${plane[@]}" --index weakest k2d.json -o plain.json
check_jq "an index without a force does not see the cut" weakest.json '.best.score == $p[0].best.score and .best.joints_deg == $p[0].best.joints_deg and .best.cut.walls[0].side == "left" and ($p[0].best | has("cut") | not)' --slurpfile p plain.json
run "${plane[@]}" --feed 0,1,0 --index deflection k2d.json -o deflection.json
check_jq "the deflection is the largest of the turn" deflection.json '.best.score > .best.deflection_um and .best.score <= (.best.cut.largest_um | map(. * .) | add | sqrt) * (1 + 1e-9)'

# The part turned by 5 degrees about the normal: the feed with it.
turned=(--plane-origin "$(jq -r '.best.tcp_mm | join(",")' surface.json)" --x 0:0:1 --y 0:0:1)
run "${turned[@]}" --feed="$(jq -nr '5 * 3.141592653589793 / 180 | "\(-sin),\(cos),0"')" k2d.json -o turned.json
check_jq "a part that is turned takes its feed along" turned.json '([$b[0].part_moved[] | select(.axis == "normal" and .turned_deg == 5) | .score] | first) / .best.score - 1 | fabs < 1e-6' --slurpfile b surface.json

# Given poses, deviations, teeth that differ.
jq '{format: "stablecut/pose-list/1", poses: [{joints_deg: .best.joints_deg}, {joints_deg: [10, -80, 80, 0, 60, 0]}]}' surface.json >poses.json
jq '.std_n_m_per_rad = [1e5, 4.53e5, 1e5, 1e5, 1e5, 1e5] | .discrepancy = {relative: 0.1, absolute_um: 5}' k2d.json >off.json
run --evaluate poses.json --feed 0,1,0 off.json -o scores.json
check_jq "evaluated as found, with deviations" scores.json '(.evaluated[0].score / $b[0].best.score - 1 | fabs) < 1e-9 and .cut == $b[0].cut and
  all(.evaluated[]; (.score_std / .cut.largest_std_um[1] - 1 | fabs) < 1e-9 and (.cut.mean_std_um | length) == 3 and .cut.walls[0].error_std_um > 5) and
  ([.evaluated[].probability_better] | map(select(.)) | length) == 1' --slurpfile b surface.json
check_jq "and none without" surface.json '.best.cut | has("mean_std_um") or has("largest_std_um") or (.walls[0] | has("error_std_um")) | not'
jq '.runout_um = [5, -5, 3, -3]' cut.json >runout.json
best-pose --robot "$robot" --quiet --cut runout.json --cut-depth 1 --evaluate poses.json --feed 0,1,0 k2d.json -o runout-scores.json
check_jq "where teeth differ, only the mean says where the wall is" runout-scores.json 'all(.evaluated[].cut.walls[]; .error_um == null and (.mean_error_um | type) == "number")'

# Paths: another place of the workpiece takes its frame into the points to send.
jq '.tool.translation_mm[0] = 150' "$robot" >offset.json
jq -n '{format: "stablecut/tool-path/1", speed_mm_per_s: 50, frame: {translation_mm: [1800, -500, 1000], rotation: [[0, -1, 0], [1, 0, 0], [0, 0, 1]]},
  points: [range(26) | {position_mm: [. * 40, 0, 0], axis: [0, 0, -1]}]}' >line.json
path=(best-pose --robot offset.json --quiet --path line.json --cut cut.json --cut-depth 1)
check "a path and a place" "${path[@]}" --place -100:200:4,-100:100:3,-30:30:3 k2d.json --offsets placed.csv -o placed.json
check_jq "offsets cancel the deflection to a thousandth" placed.json '(.points | length) == 26 and all(.points[]; [.offset_mm, .displacement_um] | transpose | map((.[0] * 1e3 + .[1]) | . * .) | add | sqrt < 0.2)'
check "points to send lie beside the path, in the workpiece's frame" awk -F, 'NR > 1 {
  if (($2 - ($1 * 40)) ^ 2 + $3 ^ 2 + $4 ^ 2 > 1) bad = 1; n++ } END { exit bad || n != 26 }' placed.csv
jq -r '.placement.frame.rotation | flatten | join(" ")' placed.json >rotation.txt
check "by the frame's rotation" awk -F, -v r="$(cat rotation.txt)" 'BEGIN { split(r, R, " ") } NR > 1 {
  w[1] = $2 - $1 * 40; w[2] = $3; w[3] = $4
  for (i = 0; i < 3; i++) { d = R[3 * i + 1] * w[1] + R[3 * i + 2] * w[2] + R[3 * i + 3] * w[3] - $(8 + i); if (d * d > 1e-10) bad = 1 } n++ } END { exit bad || n != 26 }' placed.csv
"${path[@]}" k2d.json -o two.json --offsets two.csv
"${path[@]}" --threads 1 k2d.json -o one.json --offsets one.csv
check "same bytes on one thread" cmp -s two.json one.json
check "and the same points" cmp -s two.csv one.csv
check_jq "the worst point" two.json '.index.name == "surface" and (([.points[].cut.largest_um[1]] | max) / .worst.score - 1 | fabs < 1e-9)'
"${path[@]}" --objective mean --index feed k2d.json -o mean.json
check_jq "the mean along the feed" mean.json '.objective == "mean" and (([.points[].cut.largest_um[0]] | add / 26) / .parts[0].objective - 1 | fabs < 1e-9)'

# Wrong use.
one=(best-pose --robot "$robot" --height 1200 --cut cut.json)
refused 64 '^best-pose: --cut-depth: missing' "${one[@]}" --feed 0,1,0 k2d.json
refused 64 '^best-pose: --feed: missing' "${one[@]}" --cut-depth 1 k2d.json
refused 64 '^best-pose: --feed: 0,0,0: expected a direction' "${one[@]}" --cut-depth 1 --feed 0,0,0 k2d.json
refused 64 '^best-pose: --feed: along the tool axis: expected' "${one[@]}" --cut-depth 1 --feed 0,0,1 k2d.json
refused 64 '^best-pose: --feed: along the tool axis of poses.json: /poses/0: expected' best-pose --robot "$robot" --evaluate poses.json --cut cut.json --cut-depth 1 --feed 0,0,1 k2d.json
refused 64 '^best-pose: --cut-depth: 0: expected a depth above 0' "${one[@]}" --cut-depth 0 --feed 0,1,0 k2d.json
refused 64 '^best-pose: --cut-depth: 201: expected a depth' "${one[@]}" --cut-depth 201 --feed 0,1,0 k2d.json
refused 64 '^best-pose: --cut: expected without --force' "${one[@]}" --cut-depth 1 --feed 0,1,0 --force 1,0,0 k2d.json
refused 64 '^best-pose: --cut: expected without --force' "${one[@]}" --cut-depth 1 --feed 0,1,0 --force-turning 9 k2d.json
refused 64 '^best-pose: --force-frame: expected with --force only' "${one[@]}" --cut-depth 1 --feed 0,1,0 --force-frame tool k2d.json
refused 64 '^best-pose: --cut-depth: expected with --cut only' best-pose --robot "$robot" --height 1200 --cut-depth 1 k2d.json
refused 64 '^best-pose: --feed: expected with --cut only' best-pose --robot "$robot" --height 1200 --feed 1,0,0 k2d.json
refused 64 '^best-pose: --cut: missing: expected a cut for the index surface' best-pose --robot "$robot" --height 1200 --index surface --force 1,0,0 k2d.json
refused 64 '^best-pose: --feed: expected without --path' "${path[@]}" --feed 1,0,0 k2d.json
refused 64 '^best-pose: --offsets: expected with --path only' "${one[@]}" --cut-depth 1 --feed 0,1,0 --offsets o.csv k2d.json
refused 64 '^best-pose: --offsets: expected with --cut only' best-pose --robot "$robot" --path line.json --offsets o.csv k2d.json
jq 'del(.feed_per_tooth_mm)' cut.json >no-feed.json
refused 64 '^best-pose: --cut: expected feed_per_tooth_mm and diameter_mm in the cut' best-pose --robot "$robot" --height 1200 --cut no-feed.json --cut-depth 1 --feed 0,1,0 k2d.json
jq '.teeth = 0' cut.json >bad.json
refused 65 '^best-pose: bad.json: /teeth: 0: expected' best-pose --robot "$robot" --height 1200 --cut bad.json --cut-depth 1 --feed 0,1,0 k2d.json
refused 65 '^best-pose: k2d.json: /format: .*expected "stablecut/cut/1"' best-pose --robot "$robot" --height 1200 --cut k2d.json --cut-depth 1 --feed 0,1,0 k2d.json
refused 66 '^best-pose: none.json: cannot be read' best-pose --robot "$robot" --height 1200 --cut none.json --cut-depth 1 --feed 0,1,0 k2d.json
jq '.kt_n_per_mm2 = 1e12' cut.json >hard.json
refused 65 '^best-pose: hard.json: /: .* N: expected a cut whose force is above 0 and below 1e9 N' best-pose --robot "$robot" --height 1200 --cut hard.json --cut-depth 1 --feed 0,1,0 k2d.json
check "nothing was written" test ! -e o.csv
