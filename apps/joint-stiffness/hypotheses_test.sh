#!/usr/bin/env bash
# joint-stiffness where the robot or the samples are wrong: what is named, and that --apply mends it.
. "$SOURCE/apps/testing.sh"
robot=$data/kr360.json
jq '{format: "stablecut/joint-stiffness/1", stiffness_n_m_per_rad: .k_theta_2d_n_m_per_rad}' "$data/yanshan-poses.json" >truth.json
# The paper's poses with the wrist moved, so that every joint but A6 can be told.
jq '{format: "stablecut/pose-list/1", poses: [.height_1600_mm[], .height_1200_mm[] | .joints_deg] | to_entries |
  map({joints_deg: (.key as $k | .value | .[3] += 20 * ($k % 5 - 2) | .[4] -= 7 * ($k % 3))})}' "$data/yanshan-poses.json" >poses.json
for force in "600,0,0" "0,600,0" "0,0,-600"; do
  best-pose --robot "$robot" --evaluate poses.json --force="$force" truth.json 2>/dev/null |
    jq --arg force "$force" '[.evaluated[] | {joints_deg, force_n: ($force | split(",") | map(tonumber)),
      deflection_mm: (.displacement_um | map(. / 1000))}]'
done | jq -s '{format: "stablecut/load-samples/1", frame: "base", samples: add}' >loads.json
close_to_truth='[.stiffness_n_m_per_rad, $truth[0].stiffness_n_m_per_rad] | transpose | map(select(.[0])) |
  length > 3 and all((.[0] / .[1] - 1 | fabs) < 1e-4)'

joint-stiffness --robot "$robot" loads.json -o found.json 2>.err
check "sound samples: not a word" test "$(grep -c -- --apply .err)" -eq 0
check_jq "and nothing in the document" found.json '.hypotheses == [] and .applied == []'

# wrong NAME ROBOT SAMPLES WORDS: named with these words, and mended by --apply NAME.
wrong() {
  joint-stiffness --robot "$2" "$3" -o found.json 2>.err
  check "$1 is named" grep -Eq -- "^joint-stiffness: warning: $3: $4.*: --apply $1\$" .err
  check_jq "$1 is in the document" found.json '.hypotheses[0] | .name == $name and .residual_after_um < 0.1 * .residual_before_um and .poses_better == .poses' --arg name "$1"
  mended "$@"
}
# mended NAME ROBOT SAMPLES: --apply NAME gives the true values, is recorded and ends the warning.
mended() {
  joint-stiffness --robot "$2" --apply "$1" "$3" -o mended.json 2>.err
  check_jq "--apply $1 gives the true values" mended.json "$close_to_truth" --slurpfile truth truth.json
  check_jq "--apply $1 is recorded" mended.json '.applied[0].name == $name and .hypotheses == [] and (.provenance.arguments | index(["--apply", $name]) != null or any(. == "--apply=" + $name))' --arg name "$1"
  check "no more of --apply $1" test "$(grep -c -- --apply .err)" -eq 0
}
jq '.joints[2].theta_sign *= -1' "$robot" >sign.json
wrong sign:A3 sign.json loads.json 'with the sign of A3 turned the residual falls from [0-9.]* to [0-9.e-]* um \([0-9]+ poses of [0-9]+ agree better\)'
jq '.coupling = [{joint: "A3", follows: "A2", ratio: 1}]' "$robot" >coupled.json
wrong coupling:A3=0 coupled.json loads.json 'with A3 not coupled to A2 the residual falls'
jq '.samples[].joints_deg |= (.[2] += .[1])' loads.json >from-horizontal.json
wrong coupling:A3=-1 "$robot" from-horizontal.json 'with A3 coupled to A2 by -1 the residual falls'
jq '.samples[].deflection_mm |= [.[1], -.[0], .[2]]' loads.json >turned.json
wrong turned:z90 "$robot" turned.json 'with the deflections turned by 90 degrees about z of the base frame the residual falls'
jq '(0.2 | cos) as $c | (0.2 | sin) as $s | .samples[].deflection_mm |= [$c * .[0] + $s * .[1], $c * .[1] - $s * .[0], .[2]]' loads.json >rotated.json
wrong turned "$robot" rotated.json 'with the deflections turned by .*, 11.5 degrees about x, y, z \(a rotation vector\) the residual falls'
check_jq "the fitted turn is recorded" mended.json '.applied[0].rotation_deg[2] - 0.2 * 57.29578 | fabs < 0.01'
jq '.samples[].joints_deg |= map(. * 3.14159265358979 / 180)' loads.json >radians.json
wrong angles:rad "$robot" radians.json 'with the angles taken as radians the residual falls'
jq '.samples[].force_point_mm = [100, 50, 310]' loads.json >beside.json
wrong load-point "$robot" beside.json 'with the load -100, -50, -100 mm beside its point \(flange frame\) the residual falls'
jq '.joints[3].d_mm -= 200' "$robot" >short.json
wrong length:A4 short.json loads.json 'with the link before A4 longer by 200 mm the residual falls'

# Units: the fit is as good, but no robot is as stiff.
jq '.samples[].deflection_mm |= map(. * 1000)' loads.json >um.json
jq '.samples[].deflection_mm |= map(. / 1000)' loads.json >m.json
jq '.samples[].deflection_mm |= map(. / 25.4)' loads.json >inch.json
jq '.samples[].force_n |= map(. / 9.80665)' loads.json >kgf.json
for unit in deflection:um deflection:m deflection:inch force:kgf; do
  file=${unit#*:}.json
  joint-stiffness --robot "$robot" "$file" -o found.json 2>.err
  check "$unit is named" grep -Eq "^joint-stiffness: warning: $file: the arm is [0-9.e+]+ times (softer|stiffer) than robots of 2.83 m reach usually are: are the (deflections|forces) in ${unit#*:}\\? --apply $unit\$" .err
  mended "$unit" "$robot" "$file"
done
jq -r '"A1,A2,A3,A4,A5,A6,fx_n,fy_n,fz_n,dx_um,dy_um,dz_um", (.samples[] | [.joints_deg[], .force_n[], .deflection_mm[]] | @csv)' loads.json >mm.csv
joint-stiffness --robot "$robot" mm.csv -o found.json 2>.err
check "a header says um, the numbers are mm" grep -q 'are the deflections in mm? --apply deflection:mm$' .err
mended deflection:mm "$robot" mm.csv

# Misfit: half of the deflections exchanged between samples.
jq '[.samples[].deflection_mm] as $d | .samples |= (to_entries | map(.value + {deflection_mm: $d[(.key * 7 + 5) % ($d | length)]}))' loads.json >mixed.json
joint-stiffness --robot "$robot" mixed.json -o found.json 2>.err
check "a misfit is said" grep -Eq '^joint-stiffness: warning: mixed.json: the residual of [0-9.]+ um is large beside the deflection of [0-9.]+ um' .err

# Two changes, in their order; wrong usage.
joint-stiffness --robot sign.json --apply sign:A3 --apply force:kgf kgf.json -o mended.json 2>.err
check_jq "two changes" mended.json "([.applied[].name] == [\"sign:A3\", \"force:kgf\"]) and ($close_to_truth)" --slurpfile truth truth.json
refused 64 '^joint-stiffness: --apply: sign:B3: expected one of sign:A1, .*force:kgf' joint-stiffness --robot "$robot" --apply sign:B3 loads.json
refused 64 '^joint-stiffness: --apply: expected without --plan' joint-stiffness --robot "$robot" --plan 3 --apply sign:A3 poses.json
