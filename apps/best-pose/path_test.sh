#!/usr/bin/env bash
# best-pose --path: paths in several forms, what they break, what is kept.
. "$SOURCE/apps/testing.sh"
robot=$data/kr360.json
jq '{format: "stablecut/joint-stiffness/1", stiffness_n_m_per_rad: .k_theta_2d_n_m_per_rad}' "$data/yanshan-poses.json" >k2d.json
jq '.tool.translation_mm[0] = 150' "$robot" >offset.json
run() { best-pose --robot offset.json --quiet "$@"; }

# A line of 1 m, as a document, as words and as columns.
jq -n '{format: "stablecut/tool-path/1", speed_mm_per_s: 50, frame: {translation_mm: [1800, -500, 1000], rotation: [[0, -1, 0], [1, 0, 0], [0, 0, 1]]},
  points: [range(51) | {position_mm: [. * 20, 0, 0], axis: [0, 0, -1]}]}' >line.json
{ echo "%"; for i in $(seq 0 50); do echo "N$i G1 X$((i * 20)) Y0 Z0 I0 J0 K1 F3000"; done; } >line.nc
for i in $(seq 0 50); do echo "$((i * 20)) 0 0 0 0 1"; done >line.txt
check "a path" run --path line.json --force 0,400,0 k2d.json -o line-poses.json --joints line.csv
check_jq "a pose for each point" line-poses.json '(.points | length) == 51 and .index.name == "deflection" and .objective == "worst" and (.obstacles | length) == 0
  and (.parts | map([.first, .last])) == [[0, 50]] and .points[50].time_s > 19.999 and .points[50].time_s < 20.001'
check_jq "the tool is where the path says" line-poses.json 'all(.points[]; (.tcp_mm[0] - 1800 | fabs) < 1e-6 and (.tcp_mm[1] - (-500 + .point * 20) | fabs) < 1e-6)'
check_jq "the worst point" line-poses.json '([.points[].score] | max) as $m | .worst.score / $m - 1 | fabs < 1e-9'
check_jq "speeds are kept" line-poses.json 'all(.points[].joint_speed_deg_per_s[]; fabs <= 60) and .points[0].joint_speed_deg_per_s == [0, 0, 0, 0, 0, 0]'
check_jq "and are the steps over the time" line-poses.json '[.points[7].joints_deg, .points[8].joints_deg, .points[8].joint_speed_deg_per_s] | transpose | all(((.[1] - .[0]) / 0.4 - .[2] | fabs) < 1e-6)'
check "a line of CSV for each pose and a header" test "$(wc -l <line.csv)" -eq 52
check "the joints by name" grep -q '^point,time_s,A1_deg,A2_deg' line.csv
frame=(--plane-origin "1800,-500,1000" --plane-x "0,1,0" "--plane-y=-1,0,0")
run --path line.nc "${frame[@]}" --force 0,400,0 --no-provenance k2d.json -o words.json
run --path line.txt "${frame[@]}" --path-speed 50 --force 0,400,0 --no-provenance k2d.json -o columns.json
check "words and columns are the same path" cmp -s words.json columns.json
check_jq "and that of the document" words.json '.worst.score / $l[0].worst.score - 1 | fabs < 1e-6' --slurpfile l line-poses.json
run --path line.json --force 0,400,0 --threads 1 k2d.json -o one.json
check "same bytes on one thread" cmp -s line-poses.json one.json
sed 's/K1/K-1/' line.nc >down.nc
run --path down.nc "${frame[@]}" --path-axis to-tip --force 0,400,0 --no-provenance k2d.json -o tip.json
check "the axis the other way round" cmp -s words.json tip.json
run --path line.json --force 400,0,0 --force-frame feed --no-provenance k2d.json -o feed.json
check_jq "a force along the feed" feed.json '.worst.score / $l[0].worst.score - 1 | fabs < 1e-6' --slurpfile l line-poses.json
run --path line.json --force 0,400,0 --objective mean k2d.json -o mean.json
check_jq "the mean is not worse than that of the worst's path" mean.json '([.points[].score] | add) <= ([$l[0].points[].score] | add) * (1 + 1e-6) and .objective == "mean"' --slurpfile l line-poses.json
check_jq "and its worst point not better" mean.json '.worst.score >= $l[0].worst.score * (1 - 1e-6)' --slurpfile l line-poses.json
run --path line.json --redundancy-rate 0 --force 0,400,0 k2d.json -o still.json
check_jq "a tool that does not turn" still.json '[.points[].turn_deg] | max - min < 1e-6'
run --path line.json --redundancy 30:40:3 k2d.json -o narrow.json
check_jq "an interval of the redundancy, and the weakest direction without a force" narrow.json '.index.name == "weakest" and all(.points[]; .redundancy_deg > 29.999999 and .redundancy_deg < 40.000001)'
jq '.joints[].max_speed_deg_per_s = 7' offset.json >slow.json
best-pose --robot slow.json --quiet --path line.json --force 0,400,0 k2d.json -o slow-poses.json
check_jq "speeds of the robot's document" slow-poses.json '.joint_speed_limit_deg_per_s == [7, 7, 7, 7, 7, 7] and all(.points[].joint_speed_deg_per_s[]; fabs <= 7)'
jq '.std_n_m_per_rad = [0, 4.53e5, 0, 0, 0, 0]' k2d.json >uncertain.json
run --path line.json --force 0,0,-400 uncertain.json -o spread.json
check_jq "deviations of the deflections" spread.json 'all(.points[]; .deflection_std_um > 0)'
jq '.discrepancy = {relative: 0.1, absolute_um: 20}' k2d.json >off.json
run --path line.json --force 0,0,-400 off.json -o off-path.json
check_jq "what a new pose is off by" off-path.json 'all(.points[]; (.score * 0.1) as $r | .deflection_std_um / ($r * $r + 400 | sqrt) - 1 | fabs < 1e-9)'
jq '.model = "base" | .springs = [{name: "base.x", compliance_m_per_n: 1e-7}, {name: "base.y", compliance_m_per_n: 5e-8}]' k2d.json >base.json
run --path line.json --force 0,400,0 base.json -o base-path.json
jq '{format: "stablecut/pose-list/1", poses: [.points[] | {joints_deg}]}' base-path.json >base-poses.json
run --evaluate base-poses.json --index deflection --force 0,400,0 base.json -o base-scores.json
check_jq "the deflection of all springs, as of single poses" base-path.json '[[.points[].score], [$e[0].evaluated[].score]] | transpose | all(.[0] / .[1] - 1 | fabs < 1e-9)' --slurpfile e base-scores.json

# A force that varies.
run --path line.json --force 0,400,0 --force-cone 20 k2d.json -o cone-path.json
jq '{format: "stablecut/pose-list/1", poses: [.points[] | {joints_deg}]}' cone-path.json >cone-poses.json
run --evaluate cone-poses.json --force 0,400,0 --force-cone 20 k2d.json -o cone-scores.json
check_jq "the largest deflection over a cone, as of single poses" cone-path.json '[[.points[].score], [$e[0].evaluated[].score]] | transpose | all(.[0] / .[1] - 1 | fabs < 1e-8)' --slurpfile e cone-scores.json
check_jq "which is more than that of its middle" cone-path.json 'all(.points[]; .score > .deflection_um * 1.001)'

# What cannot be driven.
jq '.points = [range(41) | {position_mm: [. * 100, 0, 0], axis: [0, 0, -1]}]' line.json >long.json
refused 1 '^best-pose: long.json: points [0-9]* to 40: out of reach' run --path long.json k2d.json
refused 1 'points [0-9]* to [0-9]*: joint speed between points: A[1-6] would need .* of 1 deg/s' run --path line.json --joint-speed 1 k2d.json
# The straight tool stands on the line x = 1800: within 1830 of axis 1 where |y| is below 330.
jq '.keep_out_radius_mm = 1830' "$robot" >guarded.json
refused 1 'points 9 to 41: tool or links in what they keep out of by' best-pose --robot guarded.json --path line.json --quiet k2d.json
refused 1 'points 20 to 30: tool or links in what they keep out of by' run --path line.json --keep-out-radius 0 --keep-out 1700:2700,-100.5:100.5,900:1100 k2d.json
refused 1 'points 0 to 50: tool or links in what they keep out of by' run --path line.json --keep-out-radius 0 --floor 1001 k2d.json
check "the rest of a path" run --path long.json --partial k2d.json -o rest.json
check_jq "with what is left out" rest.json '(.points | length) == .obstacles[0].first and .obstacles[-1].last == 40 and .obstacles[-1].constraint == "reach"'
best-pose --robot offset.json --path long.json --partial k2d.json -o rest.json 2>.err
check "is warned about" grep -q '^best-pose: warning: long.json: points .* out of reach' .err

# Where to put the workpiece.
check "places" run --path line.json --force 0,400,0 --place -200:400:4,-100:100:3,-90:90:3 --no-provenance k2d.json -o place.json
check_jq "a map of all places" place.json '(.placement.map | length) == 36 and ([.placement.map[].outcome] | unique | all(IN("driven", "not-better", "no-pose", "no-motion")))'
check_jq "the best is the best of those that were searched, and the path's" place.json '.placement.best.objective as $b | ([.placement.map[] | .objective | select(.)] | min) == $b
  and (.worst.score / $b - 1 | fabs < 1e-9) and all(.placement.map[] | select(.outcome == "not-better"); .bound >= $b * 0.98 * (1 - 1e-9))'
check_jq "and not worse than where the path puts it" place.json '.placement.best.objective <= $l[0].worst.score * (1 + 1e-9)' --slurpfile l line-poses.json
jq --slurpfile p place.json '.frame = $p[0].placement.frame' line.json >placed.json
run --path placed.json --force 0,400,0 k2d.json -o placed-poses.json
check_jq "its frame in the path's document gives the same motion" placed-poses.json '.worst.score / $p[0].worst.score - 1 | fabs < 1e-9' --slurpfile p place.json
run --path line.json --force 0,400,0 --place 0:0:1,0:0:1,0:0:1 k2d.json -o stay.json
check_jq "one place: where it was" stay.json '.worst.score == $l[0].worst.score and .placement.map[0].outcome == "driven"' --slurpfile l line-poses.json
run --path line.json --force 0,400,0 --place 0:0:1,0:0:1,-100:100:2,0:0:1 k2d.json -o high.json
check_jq "three lengths and a turn" high.json '[.placement.map[].z_mm] == [-100, 100]'
refused 1 '^best-pose: --place: the path is driven at none of 4 places: at 4 some point has no pose' run --path line.json --place 9000:9500:4,0:0:1,0:0:1 k2d.json
refused 64 '^best-pose: --place: 0:1:2,0:1:2: expected FROM:TO:COUNT for x, y' run --path line.json --place 0:1:2,0:1:2 k2d.json
refused 64 '^best-pose: --place: 0:1,0:1:2,0:1:2: expected FROM:TO:COUNT for x, y' run --path line.json --place 0:1,0:1:2,0:1:2 k2d.json
jq '.points = [range(251) | {position_mm: [. * 4, 0, 0], axis: [0, 0, -1]}]' line.json >fine.json
refused 64 '^best-pose: --path, --place: 25100000: expected at most 10000000 points of the path times places \(fewer places' run --path fine.json --place 0:1:1000,0:1:100,0:0:1 k2d.json
refused 64 '^best-pose: --place: expected with --path only' run --height 1600 --place 0:1:2,0:1:2,0:0:1 k2d.json

# Wrong use and wrong data.
refused 64 '^best-pose: --objective: expected with --path only' run --height 1600 --objective mean k2d.json
refused 64 '^best-pose: --force-frame: feed: expected with --path only' run --height 1600 --force 1,0,0 --force-frame feed k2d.json
refused 64 '^best-pose: --path: expected without --height' run --path line.json --height 1600 k2d.json
refused 64 '^best-pose: --joint-speed: 1,2: expected one number or six' run --path line.json --joint-speed 1,2 k2d.json
refused 64 '^best-pose: --joint-speed: 0: expected speeds above 0' run --path line.json --joint-speed 0 k2d.json
refused 64 '^best-pose: --joint-speed: 1e-323: expected speeds above 0' run --path line.json --joint-speed 1e-323 k2d.json
refused 65 '^best-pose: line.txt: line 1: expected a speed' run --path line.txt k2d.json
refused 65 '^best-pose: line.json: /frame: .*from one place only' run --path line.json "${frame[@]}" k2d.json
awk 'BEGIN {for (i = 0; i <= 100000; ++i) print i / 100, "0 0 0 0 1"}' >long.txt
refused 65 '^best-pose: long.txt: line 100001: expected at most 100000 points \(divide the path\)' run --path long.txt --path-speed 50 k2d.json
jq '.points = [range(100001) | {position_mm: [. / 100, 0, 0], axis: [0, 0, -1]}]' line.json >long.json
refused 65 '^best-pose: long.json: /points: .*: expected at most 100000 points \(divide the path\)' run --path long.json k2d.json
refused 66 '^best-pose: none.json: cannot be read' run --path none.json k2d.json
jq 'del(.points[3].axis)' line.json >bad.json
refused 65 '^best-pose: bad.json: /points/3/axis: missing' run --path bad.json k2d.json

# As many stretches as points: each is driven by itself, and what lies between is said in one line.
jq '[.points[]] as $p | .points = [range(51) | $p[.] | if .position_mm[0] % 40 == 20 then .position_mm[1] = 9000 else . end]' line.json >gaps.json
refused 1 '^best-pose: gaps.json: point 1: out of reach; .*; and 17 more stretches$' run --path gaps.json k2d.json
run --path gaps.json --partial k2d.json -o gaps-path.json
check_jq "every other point is a part of its own" gaps-path.json '[.parts[] | [.first, .last]] == [range(26) | [2 * ., 2 * .]] and (.obstacles | length) == 25'
run --path line.json --joint-speed 0.001 --partial k2d.json -o fast-path.json
check_jq "so is each where the joints are too slow" fast-path.json '(.parts | length) == 51 and (.obstacles | length) >= 1 and all(.obstacles[]; .constraint == "joint-speed")'

# What stands in the way at the points themselves, in words.
refused 1 '^best-pose: line.json: points 0 to 50: nearer to a singularity than the singularity margin, 0\.[0-9]*$' run --path line.json --singularity-margin 5 k2d.json
refused 1 '^best-pose: line.json: points 0 to 50: limit of joint A[1-6]: only [0-9.]* degrees from it$' run --path line.json --limit-margin 60 k2d.json
echo '2000000 0 0 0 0 1' >far.txt
refused 65 "^best-pose: far.txt: line 1: expected a position of a robot's size$" run --path far.txt --path-speed 50 k2d.json
