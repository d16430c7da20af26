#!/usr/bin/env bash
# joint-stiffness on samples: exact ones give the true values, as JSON and as CSV; what cannot be known is null; plans.
. "$SOURCE/apps/testing.sh"
robot=$data/kr360.json
same_for_every_tool joint-stiffness joint-stiffness --robot "$robot"

jq '{format: "stablecut/joint-stiffness/1", stiffness_n_m_per_rad: .k_theta_2d_n_m_per_rad}' "$data/yanshan-poses.json" >truth.json
jq '{format: "stablecut/pose-list/1", poses: [.height_1600_mm[], .height_1200_mm[] | {joints_deg}]}' "$data/yanshan-poses.json" >poses.json

# samples ROBOT FORCE...: load samples with the deflections that best-pose predicts from the true values.
samples() {
  local robot=$1; shift
  for force in "$@"; do
    best-pose --robot "$robot" --evaluate poses.json --force="$force" truth.json |
      jq --arg force "$force" '[.evaluated[] | {joints_deg, force_n: ($force | split(",") | map(tonumber)),
        deflection_mm: (.displacement_um | map(. / 1000))}]'
  done | jq -s '{format: "stablecut/load-samples/1", frame: "base", samples: add}'
}
three=("600,0,0" "0,600,0" "0,0,-600")
close_to_truth='[.stiffness_n_m_per_rad, $truth[0].stiffness_n_m_per_rad] | transpose | map(select(.[0])) |
  length > 0 and all((.[0] / .[1] - 1 | fabs) < 1e-9)'

samples "$robot" "${three[@]}" >loads.json
joint-stiffness --robot "$robot" loads.json -o found.json 2>.err
check "the joint that the loads cannot see is named" grep -q '^joint-stiffness: warning: joint A6 is not identified: the loads' .err
check "one warning" test "$(wc -l <.err)" -eq 1
check_jq "five joints, the sixth null" found.json '.identifiable == [true, true, true, true, true, false] and .rank == 5
  and .stiffness_n_m_per_rad[5] == null and .interval_95_n_m_per_rad[5] == null and .covariance_compliance[5] == [null, null, null, null, null, null]'
check_jq "exact samples give the true values" found.json "$close_to_truth" --slurpfile truth truth.json

# A point off the axis, for load and measurement: all six. As a tool, and as points of each sample.
jq '.tool.translation_mm = [150, 50, 210]' "$robot" >offset.json
samples offset.json "${three[@]}" >offset-loads.json
joint-stiffness --robot offset.json offset-loads.json -o found.json 2>.err
check_jq "all six with the tool off the axis" found.json "(.identifiable | all) and ($close_to_truth)" --slurpfile truth truth.json
check "no warning" test ! -s .err
jq '.samples[] += {force_point_mm: [150, 50, 210], measuring_point_mm: [150, 50, 210]}' offset-loads.json |
  joint-stiffness --robot "$robot" -o points.json
check_jq "the same by points" points.json '.stiffness_n_m_per_rad == $found[0].stiffness_n_m_per_rad' --slurpfile found found.json

# As a spreadsheet holds them: header with units, any order, decimal commas, empty lines, or bare columns.
jq -r '"dz [um];Fx (N);Fy [N];Fz_n;note;A6;A5;A4;A3;A2;A1;dx_um;dy_mm", (.samples[] |
  [.deflection_mm[2] * 1000, .force_n[], "pose", (.joints_deg | reverse[]), .deflection_mm[0] * 1000, .deflection_mm[1]]
  | map(tostring | gsub("\\."; ",")) | join(";")), ";;;;;;;;;;;;"' loads.json >loads.csv
joint-stiffness --robot "$robot" --quiet loads.csv -o found.json
check_jq "CSV gives the true values" found.json "$close_to_truth" --slurpfile truth truth.json
jq -r '.samples[] | [.joints_deg[], .force_n[], .deflection_mm[]] | @csv' loads.json |
  joint-stiffness --robot "$robot" --quiet -o found.json
check_jq "twelve bare columns give the true values" found.json "$close_to_truth" --slurpfile truth truth.json

sed 's/;/\t/g' loads.csv | awk -F'\t' -v OFS='\t' 'NR == 1 {print; next} {$1 = ""; print}' >no-z.csv
joint-stiffness --robot "$robot" --quiet --components xy no-z.csv -o no-z.json
check_jq "cells of components that are not used may be empty" no-z.json "$close_to_truth" --slurpfile truth truth.json
joint-stiffness --robot "$robot" loads.csv -o found.json 2>.err
check "no word on units where they are right" test "$(grep -c units .err)" -eq 0
jq '.samples[].deflection_mm |= map(. * 1000)' loads.json | joint-stiffness --robot "$robot" -o found.json 2>.err
check "micrometres taken for millimetres are noticed" grep -q 'the largest deflection is .* mm: are the units right' .err
jq '.samples[].deflection_mm |= map(-.)' loads.json >back.json
refused 1 'the deflections point against the loads' joint-stiffness --robot "$robot" back.json

# The bundled noisy samples.
joint-stiffness --robot "$robot" "$data/kr360-loads.csv" -o noisy.json
check_jq "noisy samples: within four deviations" noisy.json '[.stiffness_n_m_per_rad, .std_n_m_per_rad, $truth[0].stiffness_n_m_per_rad] | transpose |
  length == 6 and all((.[0] - .[2] | fabs) < 4 * .[1])' --slurpfile truth truth.json
check_jq "8 um of noise" noisy.json '.residual_rms_um > 7 and .residual_rms_um < 9 and .cross_validation.rms_um > .residual_rms_um'

# One component; an outlier.
jq '.samples[].deflection_mm[0:2] = [null, null]' loads.json |
  joint-stiffness --robot "$robot" --components z --quiet -o z.json
check_jq "z alone" z.json ".components == \"z\" and ($close_to_truth)" --slurpfile truth truth.json
jq '.samples[4].deflection_mm[2] += 1' loads.json >outlier.json
joint-stiffness --robot "$robot" --loss huber outlier.json -o huber.json 2>.err
check_jq "huber names the outlier" huber.json '.outliers[0] | .sample == 4 and .place == "/samples/4" and .weight < 0.1'
check "so does standard error" grep -q '/samples/4: .* deviations' .err
joint-stiffness --robot "$robot" --threads 1 outlier.json --quiet >one.json
joint-stiffness --robot "$robot" --threads 2 outlier.json --quiet >two.json
check "same bytes on one and two threads" cmp -s one.json two.json

# Vertical loads, tool straight down: joints 2 and 3; nothing at all: status 1.
jq '.samples |= map(select(.force_n[2] != 0) | .joints_deg[3] = 0 | .joints_deg[4] = 90 - .joints_deg[1] - .joints_deg[2])' loads.json >down.json
joint-stiffness --robot "$robot" --quiet down.json -o down-found.json
check_jq "tool down, vertical loads: joints 2 and 3" down-found.json '.identifiable == [false, true, true, false, false, false] and .rank == 2'
jq '.samples[].force_n = [0, 0, 0]' loads.json >unloaded.json
refused 1 '^joint-stiffness: unloaded.json: no joint can be identified: A1 is not seen' joint-stiffness --loss huber --robot "$robot" unloaded.json
refused 1 '^joint-stiffness: unloaded.json: no joint can be identified: A1 is not seen' joint-stiffness --robot "$robot" unloaded.json

# Models: what the document of best-pose holds is what identification finds again.
jq '.model = "base" | .springs = [{name: "base.x", compliance_m_per_n: 1e-7}, {name: "base.y", compliance_m_per_n: 5e-8}, {name: "base.z", compliance_m_per_n: 3e-8}]' truth.json >soft.json
mv truth.json hard.json; cp soft.json truth.json
samples offset.json "${three[@]}" >soft-loads.json
mv hard.json truth.json
joint-stiffness --robot offset.json --model base soft-loads.json -o base.json 2>.err
check_jq "the base too" base.json '.model == "base" and (.identifiable | all) and
  ([.springs, $soft[0].springs] | transpose | length == 3 and all(.[0].name == .[1].name and .[0].identifiable and (.[0].compliance_m_per_n / .[1].compliance_m_per_n - 1 | fabs) < 1e-9))' --slurpfile soft soft.json
check_jq "all models listed" base.json '[.models[].model] == ["joints", "base", "three-axis"] and .models[1].block_rms_um < 1e-6 and .models[0].block_rms_um > 1'
check_jq "a covariance of all springs" base.json '.spring_covariance | (.springs | length) == 9 and .springs[6:] == ["base.x", "base.y", "base.z"] and (.matrix | length == 9 and all(length == 9))'
joint-stiffness --robot offset.json --model best soft-loads.json -o best.json 2>.err
check_jq "the data choose it" best.json '.model == "base"'
joint-stiffness --robot offset.json soft-loads.json -o joints.json 2>.err
check "joints alone: said that the base predicts better" grep -q 'the model base predicts poses of other blocks to .* um, joints alone to .* um: --model base uses it' .err
check_jq "joints alone have no springs" joints.json '.model == "joints" and (has("springs") | not) and .discrepancy.absolute_um + .discrepancy.relative > 0'
joint-stiffness --robot offset.json --model joints soft-loads.json -o chosen.json 2>.err
check "not where joints were asked for" test "$(grep -c 'predicts poses' .err)" -eq 0
best-pose --robot offset.json --quiet --evaluate poses.json --force 0,0,-600 base.json >scores.json
best-pose --robot offset.json --quiet --evaluate poses.json --force 0,0,-600 soft.json >soft-scores.json
check_jq "best-pose reads it" scores.json '[.evaluated, $soft[0].evaluated] | transpose | length > 3 and all((.[0].score / .[1].score - 1 | fabs) < 1e-6 and .[0].score_std >= 0)' --slurpfile soft soft-scores.json
joint-stiffness --robot "$robot" --model three-axis --quiet "$data/kr360-loads.csv" -o three.json
check_jq "an uncertain joint keeps its lower bound" three.json '[.stiffness_n_m_per_rad, .interval_95_n_m_per_rad, .reasons] | transpose |
  any(.[0] == null and .[1] != null and .[1][0] > 0 and .[1][1] == null and (.[2] | test("interval")))'
refused 64 '^joint-stiffness: --model: bearings: expected joints\|base\|three-axis\|best' joint-stiffness --robot "$robot" --model bearings loads.json

# Plans.
joint-stiffness --robot "$robot" --plan 6 --expected truth.json --quiet poses.json -o plan.json
check_jq "a plan" plan.json '(.samples | length) == 6 and .rank == 5 and .std_n_m_per_rad[5] == null and .efficiency > 0.5 and
  (.std_n_m_per_rad[0:5] | all(. > 0))'
joint-stiffness --robot offset.json --plan 12 --load 500,0,0 --load 0,0,-500 --std-mm 0.01 poses.json -o plan.json
check_jq "a plan with its own loads" plan.json '([.samples[].force_n] | unique | length) <= 2 and .rank == 6'
joint-stiffness --robot "$robot" --plan 6 --expected truth.json --std-mm 50 poses.json -o plan.json 2>said
check "a plan that finds a stiffness to no better than itself says so" test "$(grep -c 'warning: joint A[1-5]: the plan would find its stiffness to [0-9.e+]* % (one' said)" \
  = "$(jq --slurpfile k truth.json '[[.model_error.std_n_m_per_rad, $k[0].stiffness_n_m_per_rad] | transpose[] | select(.[0] and .[0] > .[1])] | length' plan.json)"
check_jq "and there are some" plan.json '[[.model_error.std_n_m_per_rad, $k[0].stiffness_n_m_per_rad] | transpose[] | select(.[0] and .[0] > .[1])] | length > 0' --slurpfile k truth.json
refused 1 'too few measurements: 1 cannot tell the 5 joints apart' joint-stiffness --robot "$robot" --plan 1 --quiet poses.json
joint-stiffness --robot "$robot" --plan 12 --load-point 150,50,210 --measuring-point 150,50,210 poses.json -o plan.json
check_jq "a plan with points off the axis sees joint 6" plan.json '.rank == 6 and (.identifiable | all)'
refused 64 '^joint-stiffness: --from, --loss, --model: expected without --plan' joint-stiffness --robot "$robot" --plan 3 --loss huber poses.json
refused 64 '^joint-stiffness: --repeats, --load, --std-mm, --expected, --load-point, --measuring-point: expected with --plan only' joint-stiffness --robot "$robot" --std-mm 1 loads.json

# Poses outside the limits: samples are used and said, poses of a plan left out. Names are kept.
jq '.samples[3].joints_deg[1] = 25 | .samples[7].joints_deg[1] = 30' loads.json >outside.json
joint-stiffness --robot "$robot" outside.json -o found.json 2>.err
check "samples outside the limits are said" grep -q '^joint-stiffness: warning: outside.json: 2 of [0-9]* samples are outside the joint limits, the first /samples/3: A2 by 5 degrees' .err
jq '.poses |= [{name: "beyond", joints_deg: [0, 90, 0, 0, 0, 0]}] + . | .poses |= (to_entries | map(.value + {name: "p\(.key + 1)"}))' poses.json >named.json
joint-stiffness --robot "$robot" --plan 6 named.json -o plan.json 2>.err
check "poses outside the limits are left out" grep -q '^joint-stiffness: warning: named.json: 1 of [0-9]* poses are outside the joint limits, the first /poses/0: A2 by 70 degrees: left out' .err
check_jq "and not chosen; names are kept" plan.json '(.samples | length) == 6 and all(.samples[]; .pose > 1 and .name == "p\(.pose)")'
jq '.samples |= (to_entries | map(.value + {name: "s\(.key)"})) | .samples[4].deflection_mm[2] += 1' loads.json >outlier.json
joint-stiffness --robot "$robot" --loss huber --quiet outlier.json -o huber.json
check_jq "an outlier has its sample's name" huber.json '.outliers[0].name == "s4"'
awk -F';' -v OFS=';' 'NR == 1 {print $0, "Name"; next} !/^;*$/ {print $0, "r" NR}' loads.csv | awk -F';' -v OFS=';' 'NR == 5 {$1 = int($1) + 1000} {print}' >named.csv
joint-stiffness --robot "$robot" --loss huber --quiet named.csv -o huber.json
check_jq "also from a column" huber.json '.outliers[0].name == "r5"'
jq '.samples[].joints_deg |= map(. * 3.14159265 / 180)' loads.json >radians.json
joint-stiffness --robot "$robot" radians.json -o found.json 2>.err
check "angles in radians are noticed" grep -q 'radians.json: .*the joint angles look like radians: the largest is [0-9.]*, expected degrees' .err

# Angles of a plan that look like radians.
jq '.poses[].joints_deg |= map(. / 57.3)' poses.json | joint-stiffness --robot "$robot" --plan 6 -o plan.json 2>.err
check "a plan of poses in radians is said" grep -Eq '^joint-stiffness: warning: <stdin>: the joint angles look like radians: the largest is [0-9.]*, expected degrees$' .err
