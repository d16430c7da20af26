#!/usr/bin/env bash
# Bad input to best-pose: the right exit status, one line that names the place, nothing half-written.
. "$SOURCE/apps/testing.sh"
robot=$data/kr360.json
jq '{format: "stablecut/joint-stiffness/1", stiffness_n_m_per_rad: .k_theta_2d_n_m_per_rad}' "$data/yanshan-poses.json" >k2d.json
search=(best-pose --robot "$robot" --height 1600)

stiffness_with() {
  jq "$1" k2d.json >changed.json
  refused 65 "^best-pose: changed.json: $2" "${search[@]}" changed.json -o result.json
}
refused 64 '^best-pose: --tool-point: expected lengths in mm up to 1e6' "${search[@]}" --tool-point 0,0,1e7 k2d.json
refused 64 '^best-pose: --tool-point: 1,2: expected' "${search[@]}" --tool-point 1,2 k2d.json
stiffness_with '.stiffness_n_m_per_rad = [1, 2]' '/stiffness_n_m_per_rad: a list of 2: expected 6'
stiffness_with '.stiffness_n_m_per_rad[2] = 0' '/stiffness_n_m_per_rad/2: 0: expected a stiffness above 0'
stiffness_with '.stiffness_n_m_per_rad[2] = "x"' '/stiffness_n_m_per_rad/2: "x": expected'
stiffness_with '.stiffness_kn_m_per_rad = 1' '/stiffness_kn_m_per_rad: unknown field: expected stiffness_n_m_per_rad'
stiffness_with 'del(.stiffness_n_m_per_rad)' '/stiffness_n_m_per_rad: missing'
stiffness_with '.std_n_m_per_rad = [1, 2, 3, 4, 5, -6]' '/std_n_m_per_rad/5: -6: expected'
stiffness_with '.covariance_compliance = [[1]]' '/covariance_compliance: a list of 1: expected 6 rows'
stiffness_with '.covariance_compliance = [range(6) | [range(6)]]' '/covariance_compliance: a list of 6: expected a covariance matrix'
stiffness_with '.joints = ["A1", "A2", "A3", "A4", "joint_5", "A6"]' '/joints/4: "joint_5": expected "A5", as in the robot document'
stiffness_with '.joints = ["A1", "A2"]' '/joints: a list of 2: expected 6 names'
stiffness_with '.format = "stablecut/cut/1"' '/format: "stablecut/cut/1": expected "stablecut/joint-stiffness/1"'
stiffness_with '.model = "stiff"' '/model: "stiff": expected "joints" or "base" or "three-axis"'
stiffness_with '.model = "base"' '/springs: missing'
stiffness_with '.model = "joints" | .springs = [{name: "base.x", compliance_m_per_n: 0}]' '/springs/0/name: "base.x": expected no such spring in the model joints'
stiffness_with '.springs = [{name: "A2.z", compliance_rad_per_n_m: 0}]' '/springs/0/name: "A2.z": expected base.x'
stiffness_with '.springs = [{name: "base.x", compliance_m_per_n: -1}]' '/springs/0/compliance_m_per_n: -1: expected a compliance not below 0'
stiffness_with '.springs = [{name: "base.x", compliance_m_per_n: 1}] | .spring_covariance = {springs: ["A1.z", "base.x"], matrix: [[1, 2], [2, 1]]}' '/spring_covariance/matrix: a list of 2: expected a covariance matrix'
stiffness_with '.discrepancy = {relative: 0.1}' '/discrepancy/absolute_um: missing'
stiffness_with '.discrepancy = {relative: -0.1, absolute_um: 1}' '/discrepancy/relative: -0.1: expected a number not below 0'
refused 65 '^best-pose: <stdin>: empty input' "${search[@]}" </dev/null

jq '.joints[4].a_mm = 50' "$robot" >wrist.json
refused 65 '^best-pose: wrist.json: /joints/4/a_mm: 50: expected 0, .*spherical wrist' best-pose --robot wrist.json --height 1600 k2d.json
jq '.joints[2].alpha_deg = 10' "$robot" >skew.json
refused 65 '^best-pose: skew.json: /joints/2/alpha_deg: 10: expected 0 or 180' best-pose --robot skew.json --height 1600 k2d.json
echo '{"format": "stablecut/pose-list/1", "poses": [{"joints_deg": [0, 0, 0, 0, 0, 0]}]}' >poses.json
check "but it can be evaluated" best-pose --robot wrist.json --evaluate poses.json k2d.json -o wrist-scores.json

echo '{"format": "stablecut/pose-list/1", "poses": [{"joints_deg": [0, 0, 0]}]}' >short.json
refused 65 '^best-pose: short.json: /poses/0/joints_deg: a list of 3: expected 6' best-pose --robot "$robot" --evaluate short.json k2d.json
echo '{"format": "stablecut/pose-list/1", "poses": [{"joints_deg": [0, 90, 0, 0, 0, 0]}]}' >outside.json
best-pose --robot "$robot" --evaluate outside.json k2d.json -o scored.json 2>.err
check "a pose outside the limits is scored with a warning" grep -q '^best-pose: warning: outside.json: /poses/0/joints_deg: 70 degrees outside' .err
check_jq "and a negative margin" scored.json '.evaluated[0].limit_margin_deg == -70'

echo '{"format": "stablecut/pose-list/1", "poses": [{"joints_deg": [0, -60, -3.0714621170703906, 0, 3.0714621170703906, 0]}, {"joints_deg": [0, -60, 60, 0, 60, 0]}]}' >stretched.json
best-pose --robot "$robot" --evaluate stretched.json --index combined k2d.json -o scored.json 2>.err
check "a stretched arm is singular" grep -q '^best-pose: warning: stretched.json: /poses/0: a singular pose' .err
check_jq "no number where the arm cannot yield" scored.json '.evaluated[0].score == null and .evaluated[0].rank == 2 and .evaluated[0].stiffness_n_per_m[2] == null and .evaluated[1].rank == 1'
refused 64 '^best-pose: --force-frame: expected with --force only' "${search[@]}" --force-frame tool k2d.json
refused 64 '^best-pose: --redundancy: expected at most 3600 angles' "${search[@]}" --redundancy 0:90:4000 k2d.json
refused 1 '^best-pose: no reachable pose: nothing of the plane' "${search[@]}" --x 1e12:2e12:3 k2d.json
check "a plane far larger than the robot" "${search[@]}" --x=-1e12:1e12:3 k2d.json -o large.json
refused 64 '^best-pose: --robot: missing' best-pose --height 1600 k2d.json
refused 64 '^best-pose: --height: missing: expected the height of the plane' best-pose --robot "$robot" k2d.json
refused 64 '^best-pose: --height: x: expected a number' best-pose --robot "$robot" --height x k2d.json
refused 64 '^best-pose: --force: missing: expected a force for the index deflection' "${search[@]}" --index deflection k2d.json
refused 64 '^best-pose: --force: 0,0,0: expected a force that is not zero' "${search[@]}" --force 0,0,0 k2d.json
refused 64 '^best-pose: --force: 1,2: expected X,Y,Z' "${search[@]}" --force 1,2 k2d.json
refused 64 '^best-pose: --force-cone: expected with --force only' "${search[@]}" --force-cone 20 k2d.json
refused 64 '^best-pose: --force-cone: 91: expected an angle' "${search[@]}" --force 0,0,-1 --force-cone 91 k2d.json
refused 64 '^best-pose: --force-turning: expected without --force-cone' "${search[@]}" --force 0,0,-1 --force-cone 9 --force-turning 9 k2d.json
refused 64 '^best-pose: --force-turning: expected the index deflection' "${search[@]}" --force-turning 9 --index axial k2d.json
refused 64 '^best-pose: --keep-out: 1:2,3:4: expected XFROM' "${search[@]}" --keep-out 1:2,3:4 k2d.json
refused 64 '^best-pose: --keep-out-radius: -1: expected' "${search[@]}" --keep-out-radius=-1 k2d.json
refused 1 '^best-pose: no reachable pose: all poses within the joint limits bring tool or links into' "${search[@]}" --keep-out-radius 9000 k2d.json
refused 1 '^best-pose: no reachable pose: .*; --height: 2.6: taken as 2.6 mm; a plane at 2.6 m would be within reach too' best-pose --robot "$robot" --height 2.6 --x 9000:9100:2 k2d.json
refused 64 '^best-pose: --tool-axis: 0,0,0: expected a direction' "${search[@]}" --tool-axis 0,0,0 k2d.json
refused 64 '^best-pose: --index: soft: expected weakest\|combined' "${search[@]}" --index soft k2d.json
refused 64 '^best-pose: --x: 1:2: expected FROM:TO:COUNT' "${search[@]}" --x 1:2 k2d.json
refused 64 '^best-pose: --redundancy: expected at most a full turn' "${search[@]}" --redundancy 0:400:5 k2d.json
refused 64 '^best-pose: --limit-margin: -1: expected' "${search[@]}" --limit-margin=-1 k2d.json
refused 64 '^best-pose: --height: expected either a height or --plane-origin' "${search[@]}" --plane-origin 0,0,1 k2d.json
refused 64 '^best-pose: --plane-y: expected a direction square to --plane-x' best-pose --robot "$robot" --plane-origin 0,0,1 --plane-y 1,1,0 k2d.json
refused 64 '^best-pose: --map: expected a search' best-pose --robot "$robot" --evaluate poses.json --map m.json k2d.json
refused 64 '^best-pose: --assume: A1: expected JOINT=K' "${search[@]}" --assume A1 k2d.json
refused 64 '^best-pose: --assume: A1=1e-320: expected JOINT=K' "${search[@]}" --assume A1=1e-320 k2d.json
refused 64 '^best-pose: same.json: expected another output' "${search[@]}" --map same.json -o same.json k2d.json
refused 64 'at most 4000000 points' "${search[@]}" --x 0:1:3000 --y 0:1:3000 k2d.json
refused 74 '^best-pose: /dev/full: cannot be written' "${search[@]}" --map /dev/full k2d.json
refused 64 '^best-pose: --force: .*below 1e9 N' "${search[@]}" --force 0,0,1e308 k2d.json
refused 73 '^best-pose: none/map.json: cannot be created' "${search[@]}" --map none/map.json -o result.json k2d.json
refused 66 '^best-pose: none.json: cannot be read' best-pose --robot "$robot" --evaluate none.json k2d.json
check "nothing was written" test ! -e result.json -a ! -e same.json

# Robots whose inverse kinematics is not this one: what is wrong with which parameter.
while read -r change pattern; do
  jq "$change" "$data/kr360.json" >other.json
  refused 65 "^best-pose: other.json: $pattern" best-pose --robot other.json --height 1600 k2d.json
done <<'END'
.joints[2].a_mm=0 /joints/2/a_mm: 0: expected an upper arm longer than 0
.joints[3].a_mm=0|.joints[3].d_mm=0 /joints/3/d_mm: 0: expected a forearm longer than 0
.joints[4].alpha_deg=80 /joints/4/alpha_deg: 80: expected 90 or -90, since the axes of the wrist have to cross
.joints[4].d_mm=30 /joints/4/d_mm: 30: expected 0, since axes 4, 5 and 6 have to meet in one point
END
refused 1 '^best-pose: no reachable pose: all poses within the joint limits are nearer to a singularity than the singularity margin$' \
  best-pose --robot "$data/kr360.json" --height 1600 --x 1500:1700:3 --y 0:200:3 --singularity-margin 5 k2d.json
