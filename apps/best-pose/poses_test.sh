#!/usr/bin/env bash
# best-pose: published poses scored, published optima found, maps, families, what is missing.
. "$SOURCE/apps/testing.sh"
robot=$data/kr360.json
same_for_every_tool best-pose pose --robot "$robot" --height 1600
jq '{format: "stablecut/joint-stiffness/1", stiffness_n_m_per_rad: .k_theta_2d_n_m_per_rad}' "$data/yanshan-poses.json" >k2d.json
run() { best-pose --robot "$robot" --quiet "$@" k2d.json; }

# Tables 2 and 3: heights, and the deflections by independent code to 1 um.
evaluate() {
  jq "{format: \"stablecut/pose-list/1\", poses: [.$1[] | {joints_deg}]}" "$data/yanshan-poses.json" >poses.json
  run --evaluate poses.json --force 0,0,-588.6 --index deflection -o "$1.json"
  check_jq "$1: deflections" "$1.json" "[[.evaluated[].deflection_um], $2] | transpose | length == 6 and all(.[0] - .[1] | fabs <= 1)"
  check_jq "$1: tool points" "$1.json" "[[.evaluated[].tcp_mm], [\$paper[0].$1[].model_tcp_mm]] | transpose | length == 6 and
    all(transpose | all(.[0] - .[1] | fabs <= 0.001))" --slurpfile paper "$data/yanshan-poses.json"
}
evaluate height_1600_mm '[242, 315, 521, 598, 663, 383]'
evaluate height_1200_mm '[277, 268, 357, 450, 333, 596]'
check_jq "Table 2 lies at 1.594 to 1.601 m" height_1600_mm.json '[.evaluated[].tcp_mm[2]] | min > 1594 and max < 1601.5'
check_jq "pose 1 of Table 2 is the stiffest" height_1600_mm.json '.evaluated[0].rank == 1'
check_jq "margins inside the limits" height_1600_mm.json 'all(.evaluated[]; .limit_margin_deg > 0 and .singularity_margin > 0)'

jq '.poses |= (to_entries | map(.value + {name: "pose \(.key)"}))' poses.json >named.json
run --evaluate named.json -o named-scores.json
check_jq "names are kept" named-scores.json '[.evaluated[].name] == [range(6) | "pose \(.)"]'
jq '.joints = ["A1", "A2", "A3", "A4", "A5", "A6"]' k2d.json >own.json
check "the stiffness of this robot" best-pose --robot "$robot" --evaluate named.json own.json -o own-scores.json

# Optima straight down (independent code; 6.381e6 on A3's limit, where that has 6.37e6 near it), to 0.1 %; the limit margin
# decides.
optimum() {
  local name=$1 filter=$2; shift 2
  run "$@" -o best.json
  check_jq "$name" best.json "def near(a; b): (a / b - 1 | fabs) < 0.001; .best as \$b | (\$b.tcp_mm[0:2] | map(. * .) | add | sqrt) as \$radius | $filter"
}
down=(--force "0,0,-588.6" --limit-margin 0 --singularity-margin 0.01 --keep-out-radius 0)
optimum "1.6 m, deflection: on A2's limit" 'near($b.score; 197.3) and near($radius; 689) and ($b.joints_deg[1] + 130 | fabs) < 1e-6' --height 1600 --index deflection "${down[@]}"
optimum "1.2 m, deflection: inside" 'near($b.score; 211.1) and near($radius; 898) and near($b.joints_deg[1]; -110.8)' --height 1200 --index deflection "${down[@]}"
optimum "1.2 m, weakest: on A3's limit" 'near($b.score; 1.543e6) and ($b.joints_deg[2] - 144 | fabs) < 1e-6' --height 1200 --index weakest "${down[@]}"
optimum "1.2 m, axial: inside" 'near($b.score; 2.788e6) and near($radius; 898)' --height 1200 --index axial "${down[@]}"
optimum "1.2 m, combined: near A3's limit" 'near($b.score; 6.381e6)' --height 1200 --index combined "${down[@]}"
optimum "five degrees inside" '($b.joints_deg[1] + 125 | fabs) < 1e-6 and ($b.limit_margin_deg - 5 | fabs) < 1e-6' --height 1600 --index deflection --force 0,0,-588.6 --limit-margin 5
optimum "a load that is not vertical" 'near($b.score; 117.5) and ($b.tcp_mm[0] - 592 | fabs) < 2 and (($b.tcp_mm[1] | fabs) - 353 | fabs) < 2' --height 1600 --index deflection --force 400,0,-400 --limit-margin 0
check_jq "and its mirror image" best.json '[.families[].kind] | index("equal") != null and index("base-turn") == null'
optimum "the same on a coarse grid" 'near($b.score; 117.5)' --height 1600 --index deflection --force 400,0,-400 --limit-margin 0 --x=-2000:2500:4 --y=-2000:2000:3
optimum "a force that turns with the tool" 'near($b.score; $b.deflection_um)' --height 1600 --index deflection --force 300,0,-300 --force-frame tool
optimum "a point: the redundancy is all that is left" '($b.tcp_mm | map(round)) == [1500, 200, 1600]' --height 1600 --x 1500:1500:1 --y 200:200:1
jq '.tool.translation_mm = [10, 0, 310]' "$robot" >long.json
best-pose --robot long.json --quiet --no-provenance --height 1600 --index weakest k2d.json -o long-document.json
run --no-provenance --height 1600 --index weakest --tool-point 10,0,310 >long-option.json
check "a tool by option" cmp -s long-document.json long-option.json
optimum "a wall: a vertical plane, tool along x" '($b.tcp_mm[0] - 2000 | fabs) < 1e-6 and .plane.origin_mm == [2000, 0, 1500]' --plane-origin 2000,0,1500 --plane-x 0,1,0 --plane-y 0,0,1 --tool-axis 1,0,0

# The sweep that cannot matter.
best-pose --robot "$robot" --height 1600 --index weakest k2d.json 2>.err >weakest.json
check "weakest: warned" grep -q '^best-pose: warning: --redundancy: the tool is coaxial with joint A6' .err
check_jq "weakest: families" weakest.json '.redundancy_matters == false and ([.families[].kind] | contains(["base-turn", "tool-turn", "flipped-wrist"]))'
best-pose --robot "$robot" --height 1600 --index combined k2d.json 2>.err >combined.json
check "combined: not warned" test ! -s .err
jq '.tool.translation_mm[0] = 200' "$robot" >offset.json
best-pose --robot offset.json --height 1600 --index weakest --x 1500:1500:1 --y 300:300:1 k2d.json 2>.err >offset-best.json
check "offset tool: not warned" test ! -s .err
check_jq "offset tool: the sweep shows how much it matters" offset-best.json '.best.score / ([.redundancy_sweep.score[] | select(.)] | min) > 1.2
  and .best.score >= ([.redundancy_sweep.score[] | select(.)] | max)'

# What the force may be, what is kept out of, and what an answer stands on.
run --height 1600 --force 0,0,-500 --force-cone 30 -o cone.json
check_jq "a cone: the deflection under the worst of its forces" cone.json '.index.name == "deflection" and .best.score > .best.deflection_um and
  ((.best.worst_force_n | map(. * .) | add | sqrt) - 500 | fabs) < 1e-9 and ((.best.worst_force_n[2] + 500 * (3 | sqrt) / 2) | . > -67 and . < 1e-9)'
jq '{format: "stablecut/pose-list/1", poses: [{joints_deg: .best.joints_deg}]}' cone.json >cone-pose.json
run --evaluate cone-pose.json --index deflection --force="$(jq -r '.best.worst_force_n | join(",")' cone.json)" -o worst.json
check_jq "which is that of the worst force by itself" worst.json '.evaluated[0].deflection_um / $c[0].best.score - 1 | fabs < 1e-9' --slurpfile c cone.json
run --height 1600 --force 0,0,-300 --force-turning 400 -o turning.json
check_jq "a force that turns about the tool axis" turning.json '.best.worst_force_n as $f | ($f[2] + 300 | fabs) < 1e-9 and (($f[0:2] | map(. * .) | add | sqrt) - 400 | fabs) < 1e-9'
run --height 1200 -o default.json
check_jq "the weakest direction by default, away from singularities, outside the column" default.json '.index.name == "weakest" and .keep_out.radius_mm == 500 and .best.keep_out_margin_mm >= 0 and .best.singularity_margin >= 0.1'
check_jq "and it stands on A3's limit margin" default.json '.best.stands_on == {interior: false, joint_limits: ["A3"], others: []} and (.best.joint_margin_deg[2] - 2 | fabs) < 1e-6'
check_jq "six ways to move the part and six to turn it" default.json '(.part_moved | length) == 12 and ([.part_moved[] | select(.axis == "normal" and .turned_deg) | .score] | all(. / $d[0].best.score - 1 | fabs < 1e-6))' --slurpfile d default.json
run --height 1200 --keep-out-radius 1000 -o far.json
check_jq "a wider column pushes the tool out" far.json '(.best.tcp_mm[0:2] | map(. * .) | add | sqrt) >= 1000 - 1e-6 and .best.stands_on.others == ["keep-out"]'
jq '.keep_out_radius_mm = 1000' "$robot" >wide.json
best-pose --robot wide.json --quiet --height 1200 k2d.json -o wide-best.json
check_jq "so does the document's" wide-best.json '.best.score == $f[0].best.score' --slurpfile f far.json
run --height 1200 --x 900:1500:7 --y -300:300:7 --keep-out 0:1000,-1000:1000,1000:1400 -o box.json
check_jq "a box" box.json '.best.tcp_mm[0] >= 1000 - 1e-6 and (.keep_out.boxes[0].most_mm[2] - 1400 | fabs) < 1e-9'
run --height 1200 --floor 1100 -o floor.json
check_jq "a floor below the tool" floor.json '.keep_out.floor_mm == 1100 and .best.score == $d[0].best.score' --slurpfile d default.json
best-pose --robot "$robot" --height 1.6 k2d.json 2>.err >low.json
check "a height that may be in metres" grep -q '^best-pose: warning: --height: 1.6: taken as 1.6 mm; a plane at 1.6 m would be within reach too$' .err

# Maps.
run --height 1600 --x=-2600:2600:27 --y=-2600:2600:27 --map map.json -o best.json
check_jq "the map's shape" map.json '(.score | length) == 27 and (.score | all(length == 27)) and (.x_mm | length) == 27 and .height_mm == 1600'
check_jq "the map stays below the best" map.json '[.score[][] | select(.)] | length > 300 and max <= $best[0].best.score' --slurpfile best best.json
check_jq "null together" map.json '[.score[][], null] as $s | [[.score[][]], [.redundancy_deg[][]], [.branch[][]]] | transpose | all((map(. == null) | unique | length) == 1)'
check_jq "the centre is out of reach" map.json '.score[13][13] == null'
run --height 1600 --x=-2600:2600:27 --y=-2600:2600:27 --map one.json --threads 1 -o one-best.json
check "same bytes on one thread" cmp -s map.json one.json
check "same best on one thread" cmp -s best.json one-best.json

# Joints without a stiffness.
jq '.stiffness_n_m_per_rad[0] = null | .stiffness_n_m_per_rad[5] = null' k2d.json >partial.json
refused 1 '^best-pose: partial.json: /stiffness_n_m_per_rad/0: null: A1, A6 not identified: .*--assume A1=K --assume A6=K' best-pose --robot "$robot" --height 1600 partial.json
best-pose --robot "$robot" --height 1600 --index combined --assume A1=6.89e6 --assume A6=6.32e5 partial.json >assumed.json
check_jq "assumed stiffness gives the same pose" assumed.json '(.best.score / $b[0].best.score - 1 | fabs) < 1e-9' --slurpfile b combined.json
jq '.stiffness_n_m_per_rad[5] = null' k2d.json >no6.json
refused 1 'any K: the tool point lies on this joint' best-pose --robot "$robot" --height 1600 no6.json
refused 64 '^best-pose: --assume: A1: .*has a stiffness' best-pose --robot "$robot" --height 1600 --assume A1=1e6 k2d.json
refused 64 '^best-pose: --assume: B1: expected one of A1, A2' best-pose --robot "$robot" --height 1600 --assume B1=1e6 k2d.json

# Uncertainty: 10 % on joint 2 alone.
jq '.std_n_m_per_rad = [0, 4.53e5, 0, 0, 0, 0]' k2d.json >uncertain.json
best-pose --robot "$robot" --quiet --evaluate poses.json --force 0,0,-588.6 --index deflection uncertain.json >spread.json
jq '.stiffness_n_m_per_rad[1] *= 1.001' k2d.json >stiffer.json
best-pose --robot "$robot" --quiet --evaluate poses.json --force 0,0,-588.6 --index deflection stiffer.json >shifted.json
check_jq "deviations are the slope times the deviation" spread.json '[.evaluated, $shifted[0].evaluated] | transpose | length == 6 and
  all((.[0].score_std / ((.[0].score - .[1].score) * 100) - 1 | fabs) < 0.01)' --slurpfile shifted shifted.json
check_jq "probabilities" spread.json '[.evaluated[] | select(.rank > 1) | .probability_better] | length == 5 and all(. >= 0 and . < 0.5)'

# A base and bearings that yield: best-pose uses what the document holds.
jq '.model = "base" | .springs = [{name: "base.x", compliance_m_per_n: 1e-7, std_m_per_n: 1e-8}, {name: "base.y", compliance_m_per_n: 5e-8}]' k2d.json >base.json
best-pose --robot "$robot" --quiet --evaluate poses.json --force=100,0,0 --index deflection k2d.json >stiff-base.json
best-pose --robot "$robot" --quiet --evaluate poses.json --force=100,0,0 --index deflection base.json >soft-base.json
check_jq "100 N along x move the base by 10 um along x" soft-base.json '[.evaluated, $stiff[0].evaluated] | transpose |
  length == 6 and all([.[0].displacement_um, .[1].displacement_um] | transpose | map(.[0] - .[1]) |
    ((.[0] - 10 | fabs) < 1e-9 and (.[1] | fabs) < 1e-9 and (.[2] | fabs) < 1e-9))' --slurpfile stiff stiff-base.json
check_jq "and its deviation is 1 um of that, turned into the deflection" soft-base.json 'all(.evaluated[];
  (.deflection_std_um - (.displacement_um[0] / .deflection_um | fabs)) | fabs < 1e-6)'
best-pose --robot "$robot" --height 1600 --index weakest base.json 2>.err >base-best.json
check_jq "a base that is not alike is not free to turn" base-best.json '([.families[].kind] | index("base-turn")) == null and .redundancy_matters == false'
jq '.springs[1].compliance_m_per_n = 1e-7' base.json >alike.json
best-pose --robot "$robot" --height 1600 --index weakest --map map.json alike.json 2>.err >base-best.json
check_jq "one that is alike is" base-best.json '([.families[].kind] | index("base-turn")) != null'
check_jq "the map is of the same springs" base-best.json '.best.score >= ([$map[0].score[][] | select(.)] | max)' --slurpfile map map.json
jq '.model = "three-axis" | .springs = [{name: "A6.x", compliance_rad_per_n_m: 2e-6}, {name: "A6.y", compliance_rad_per_n_m: null}]' k2d.json >bearing.json
best-pose --robot "$robot" --height 1600 --index weakest bearing.json 2>.err >bearing-best.json
check_jq "a bearing of joint 6 that yields about x alone: the turn matters" bearing-best.json '.redundancy_matters == true and ([.families[].kind] | index("tool-turn")) == null and
  .best.score > 1.0001 * ([.redundancy_sweep.score[] | select(.)] | min)'
check "what has no compliance is said to be rigid" grep -q '^best-pose: warning: bearing.json: /springs: A6.y: not identified: taken as rigid$' .err
check "and nothing else" test "$(wc -l <.err)" -eq 1

# A discrepancy covers what a new pose shows, also without a covariance.
jq '.discrepancy = {relative: 0.1, absolute_um: 20}' k2d.json >off.json
best-pose --robot "$robot" --quiet --evaluate poses.json --force 0,0,-588.6 --index deflection off.json >off-scores.json
check_jq "a tenth and 20 um" off-scores.json 'all(.evaluated[]; (.deflection_std_um - ((0.1 * .deflection_um | . * .) + 400 | sqrt)) | fabs < 1e-9) and
  all(.evaluated[]; (.score_std - .deflection_std_um) | fabs < 1e-9) and all(.evaluated[] | select(.rank > 1); .probability_better > 0 and .probability_better < 0.5)'
jq '.discrepancy.force_n = 500' off.json >off-load.json
best-pose --robot "$robot" --quiet --height 1600 --index axial off-load.json >off-best.json
check_jq "of a stiffness: a tenth, and 20 um of what 500 N give" off-best.json '(.best.score_std / .best.score - (0.01 + (20e-6 * .best.score / 500 | . * .) | sqrt)) | fabs < 1e-9'
jq '.std_n_m_per_rad = [1e5, 1e5, 1e5, 1e5, 1e5, 1e5]' off.json >off-std.json
best-pose --robot "$robot" --quiet --evaluate poses.json --force 0,0,-588.6 --index deflection off-std.json >both.json
check_jq "beside the covariance" both.json '[.evaluated, $off[0].evaluated] | transpose | all(.[0].score_std > .[1].score_std)' --slurpfile off off-scores.json

# A score that is smaller than what is not known of it is said to be: of a search, of given poses, of a path.
jq '.std_n_m_per_rad = [.stiffness_n_m_per_rad[] | 3 * .]' k2d.json >vague.json
untold='the score [0-9.e+]* N/m is smaller than its own standard deviation, [0-9.e+]*: the joint stiffness does not tell how stiff this is$'
best-pose --robot "$robot" --height 1600 --x 1500:1700:3 --y 0:200:3 vague.json >vague-best.json 2>said
check "a vague score of the best pose is said" grep -Eq "^best-pose: warning: the best pose: $untold" said
check_jq "and is" vague-best.json '.best.score_std > .best.score'
best-pose --robot "$robot" --evaluate poses.json vague.json 2>said >vague-scores.json
check "of each given pose" test "$(grep -Ec "^best-pose: warning: poses.json: /poses/[0-9]+: $untold" said)" = "$(jq '[.evaluated[] | select(.score_std > .score)] | length' vague-scores.json)"
best-pose --robot "$robot" --path "$data/zigzag-path.json" --index combined vague.json 2>said >vague-path.json
check "of the points of a path, once" test "$(grep -Ec "^best-pose: warning: .*zigzag-path.json: [0-9]+ points, the first [0-9]+: $untold" said)" -eq 1
jq '.std_n_m_per_rad = [.stiffness_n_m_per_rad[] | 0.1 * .]' k2d.json >clear.json
best-pose --robot "$robot" --height 1600 --x 1500:1700:3 --y 0:200:3 clear.json 2>said >/dev/null
check "a score that is known is no matter for a word" test ! -s said

# A joint with a lower bound only.
jq '.stiffness_n_m_per_rad[3] = null | .interval_95_n_m_per_rad = [null, null, null, [1.23e6, null], null, null]' k2d.json >bound.json
refused 1 '/stiffness_n_m_per_rad/3: null: A4 not identified: .*--assume A4=K \(by its 95 % interval A4 above 1.23e\+0?6 N m/rad\)' best-pose --robot "$robot" --height 1600 bound.json

# No pose.
refused 1 '^best-pose: no reachable pose: nothing of the plane is within' best-pose --robot "$robot" --height 9000 k2d.json
refused 1 '^best-pose: no reachable pose: at best joint A[1-6] would be .* outside its limits' best-pose --robot "$robot" --height 1600 --x 0:300:4 --y 0:0:1 --tool-axis 0,0,1 k2d.json
