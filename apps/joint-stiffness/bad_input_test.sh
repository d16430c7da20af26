#!/usr/bin/env bash
# Bad input to joint-stiffness: the right exit status, one line that names the place, nothing half-written.
. "$SOURCE/apps/testing.sh"
robot=$data/kr360.json
cat >loads.json <<'END'
{"format": "stablecut/load-samples/1", "frame": "base", "samples": [
 {"joints_deg": [0, -100, 110, 0, 83, 0], "force_n": [0, 0, -600], "deflection_mm": [0.1, 0, -0.2]},
 {"joints_deg": [0, -60, 70, 0, 83, 0], "force_n": [0, 0, -600], "deflection_mm": [0.1, 0, -0.4]}]}
END

# robot_with FILTER PLACE, samples_with FILTER PLACE: changed by a jq filter, refused with that place and status 65.
robot_with() {
  jq "$1" "$robot" >robot.json
  refused 65 "^joint-stiffness: robot.json: $2" joint-stiffness --robot robot.json loads.json -o result.json
}
robot_with '.convention = "dh"' '/convention: "dh": expected "modified-dh"'
robot_with 'del(.joints[5])' '/joints: a list of 5: expected 6 joints'
robot_with '.joints[2].theta_sign = 0' '/joints/2/theta_sign: 0: expected 1 or -1'
robot_with '.joints[2].max_deg = -200' '/joints/2/max_deg: -200: expected an angle above min_deg'
robot_with '.joints[2].a_m = 1' '/joints/2/a_m: unknown field: expected a_mm'
robot_with 'del(.joints[0].alpha_deg)' '/joints/0/alpha_deg: missing'
robot_with '.joints[1].name = "A1"' '/joints/1/name: "A1": expected names that differ'
robot_with '.flange.rotation[0][0] = 1' '/flange/rotation: a list of 3: expected a rotation matrix'
robot_with '.tool.translation_mm = [1, 2]' '/tool/translation_mm: a list of 2: expected 3 numbers'
robot_with 'del(.tool)' '/tool: missing'
robot_with '.coupling = [{joint: "A9", follows: "A2", ratio: 1}]' '/coupling/0/joint: "A9": expected one of A1, A2, A3, A4, A5, A6'
robot_with '.coupling = [{joint: "A3", follows: "A4", ratio: 1}]' '/coupling/0/follows: "A4": expected one of A1, A2$'
robot_with '.coupling = [{joint: "A1", follows: "A2", ratio: 1}]' '/coupling/0/joint: "A1": expected a joint after the first'
robot_with '.coupling = [{joint: "A3", follows: "A2", ratio: 1}, {joint: "A3", follows: "A1", ratio: 1}]' '/coupling/1/joint: "A3": expected each joint once'
robot_with '.coupling = [{joint: "A5", follows: "A4", ratio: 0.5}]' '/coupling/0/ratio: 0.5: expected a whole number, since A4'
robot_with '.coupling = [{joint: "A3", follows: "A2"}]' '/coupling/0/ratio: missing'
robot_with '.joints[2].coupled_max_deg = 90' '/joints/2/coupled_max_deg: 90: expected with an entry for A3 in coupling only'
robot_with '.joints[2] += {coupled_min_deg: 90, coupled_max_deg: 80} | .coupling = [{joint: "A3", follows: "A2", ratio: 1}]' '/joints/2/coupled_max_deg: 80: expected an angle above'
robot_with '.joints[2].mass_kg = 10' '/joints/2: .*expected center_mm with mass_kg'
robot_with '.joints[2] += {mass_kg: -1, center_mm: [0, 0, 0]}' '/joints/2/mass_kg: -1: expected a mass'
robot_with '.joints[2].capsules = [{from_mm: [0, 0, 0], to_mm: [0, 0, 1], radius_mm: 0}]' '/joints/2/capsules/0/radius_mm: 0: expected a radius'
robot_with '.base_capsules = [{from_mm: [0, 0, 0], radius_mm: 1}]' '/base_capsules/0/to_mm: missing'
robot_with '.base = {translation_mm: [0, 0, 0], rotation: [[1, 0, 0], [0, 1, 0], [0, 0, 2]]}' '/base/rotation: .*expected a rotation matrix'
robot_with '.keep_out_radius_mm = -1' '/keep_out_radius_mm: -1: expected a radius'
robot_with '.keep_out_radius_m = 1' '/keep_out_radius_m: unknown field: expected keep_out_radius_mm'
robot_with '.format = "stablecut/pose/1"' '/format: "stablecut/pose/1": expected "stablecut/robot/1"'
samples_with() {
  jq "$1" loads.json >changed.json
  refused 65 "^joint-stiffness: changed.json: $2" joint-stiffness --robot "$robot" changed.json -o result.json
}
samples_with '.frame = "tool"' '/frame: "tool": expected "base"'
samples_with '.samples = []' '/samples: a list of 0: expected'
samples_with '.samples[1].joints_deg = [1, 2]' '/samples/1/joints_deg: a list of 2: expected 6'
samples_with '.samples[1].joints_deg[3] = "x"' '/samples/1/joints_deg/3: "x": expected'
samples_with '.samples[0].force_n = [1, 2, null]' '/samples/0/force_n/2: null: expected a force'
samples_with '.samples[0].deflection_mm[0] = null' '/samples/0/deflection_mm/0: null: expected'
samples_with 'del(.samples[0].deflection_mm)' '/samples/0/deflection_mm: missing'
samples_with '.samples[0].deflection_um = [1, 2, 3]' '/samples/0/deflection_um: unknown field: expected deflection_mm'
samples_with '.samples[0].std_mm = 0' '/samples/0/std_mm: 0: expected a standard deviation above 0'
samples_with '.samples[0].std_mm = 0.01' '/samples/1/std_mm: expected std_mm in all samples or in none'
samples_with '.samples[].std_mm = 0.01 | .samples[1].rotation_rad = [0, 0, 0]' '/samples/1/std_rad: expected std_rad with std_mm'
samples_with '.format = "stablecut/frf/1"' '/format: "stablecut/frf/1": expected "stablecut/load-samples/1"'
refused 65 '^joint-stiffness: <stdin>: empty input' joint-stiffness --robot "$robot" </dev/null
head -c 150 loads.json >cut.json
refused 65 '^joint-stiffness: cut.json: line [0-9]+: .*ends here' joint-stiffness --robot "$robot" cut.json

# csv_is TEXT PLACE
csv_is() {
  printf "$1" >loads.csv
  refused 65 "^joint-stiffness: loads.csv: $2" joint-stiffness --robot "$robot" loads.csv
}
header='A1,A2,A3,A4,A5,A6,Fx,Fy,Fz,dx,dy,dz\n'
csv_is "${header}1,2,3,4,5,6,0,0,x,1,2,3\n" 'line 2: "x": expected a number in column 9'
csv_is "${header}1,2,3\n" 'line 2: 3 columns: expected a number in column 4'
csv_is "${header}" 'line 1: expected rows below the header'
csv_is 'A1,A2,A3,A4,A5,Fx,Fy,Fz,dx,dy,dz\n1,2\n' 'line 1: expected a column A6'
csv_is 'A1,A2,A3,A4,A5,A6,Fx,Fy,Fz,dx,dy\n1,2\n' 'line 1: expected a column dz'
csv_is 'A1,A2,A3,A4,A5,A6,Fx,Fy,Fz,dx,dy,dz_furlong\n1,2\n' 'line 1: expected a column dz'
csv_is 'A1,A2,A3,A4,A5,A6,Fx,Fy,Fz,dx,dy,dz [inch]\n1,2\n' 'line 1: "dz \[inch\]": expected a unit'
csv_is 'A1,A2,A3,A4,A5,A6,Fx,Fy,Fz,dx,dy,dz,dz_um\n1,2\n' 'line 1: "dz_um": expected each column once'
csv_is '1,2,3\n' 'line 1: 3 columns: expected a header, or 12 columns'
csv_is "A1,A2,A3,A4,A5,A6,Fx,Fy,Fz,dx,dy,dz,std\n1,2,3,4,5,6,0,0,9,1,2,3,0\n" 'line 2: 0: expected a standard deviation above 0'
csv_is "${header}1,5,2,5,3,5,4,5,5,5,6,5,0,0,9,1,2,3\n" 'line 2: 18 columns: expected 12'
csv_is "A1,A2,A3,A4,A5,A6,Fx,Fy,Fz,dx,dy,dz,rx\n1,2,3,4,5,6,0,0,9,1,2,3,0\n" 'line 1: expected a column ry'
csv_is "A1,A2,A3,A4,A5,A6,Fx,Fy,Fz,dx,dy,dz,force_point_x\n1,2,3,4,5,6,0,0,9,1,2,3,0\n" 'line 1: expected a column force_point_y'
refused 65 '^joint-stiffness: loads.json: line 1:' joint-stiffness --robot "$robot" --from csv loads.json
refused 65 '^joint-stiffness: loads.csv: line 1' joint-stiffness --robot "$robot" --from json loads.csv


# Angles in radians, poses outside the limits, the stiffness of another robot.
jq '.samples[].joints_deg |= map(. * 3.14159265 / 180) | .samples[].force_n = [0, 0, 0]' loads.json >radians.json
refused 1 '^joint-stiffness: radians.json: no joint can be identified: .*; the joint angles look like radians: the largest is 1.92, expected degrees$' joint-stiffness --robot "$robot" radians.json
echo '{"format": "stablecut/pose-list/1", "poses": [{"joints_deg": [0, 90, 0, 0, 0, 0]}, {"joints_deg": [0, 0, 150, 0, 0, 0]}]}' >outside.json
refused 1 '^joint-stiffness: outside.json: 2 of 2 poses are outside the joint limits, the first /poses/0: A2 by 70 degrees$' joint-stiffness --robot "$robot" --plan 3 outside.json
echo '{"format": "stablecut/joint-stiffness/1", "joints": ["A1", "A2", "J3", "A4", "A5", "A6"], "stiffness_n_m_per_rad": [1e6, 1e6, 1e6, 1e6, 1e6, 1e6]}' >other.json
refused 65 '^joint-stiffness: other.json: /joints/2: "J3": expected "A3", as in the robot document' joint-stiffness --robot "$robot" --plan 3 --expected other.json outside.json
refused 64 '^joint-stiffness: --robot: missing: expected a robot document' joint-stiffness loads.json
refused 64 '^joint-stiffness: --components: xq: expected' joint-stiffness --robot "$robot" --components xq loads.json
refused 64 '^joint-stiffness: --components: xx: expected' joint-stiffness --robot "$robot" --components xx loads.json
refused 64 '^joint-stiffness: --loss: l1: expected squared\|huber' joint-stiffness --robot "$robot" --loss l1 loads.json
refused 64 '^joint-stiffness: --load: 1,2: expected X,Y,Z' joint-stiffness --robot "$robot" --plan 3 --load 1,2 loads.json
refused 64 '^joint-stiffness: --plan: 0: expected' joint-stiffness --robot "$robot" --plan 0 loads.json
refused 64 '^joint-stiffness: -: expected standard input for one input only' joint-stiffness --robot - <"$robot"
refused 66 '^joint-stiffness: none.json: cannot be read' joint-stiffness --robot none.json loads.json
refused 65 '^joint-stiffness: loads.json: /format: .*expected "stablecut/pose-list/1"' joint-stiffness --robot "$robot" --plan 3 loads.json
refused 74 '^joint-stiffness: /dev/full: cannot be written' joint-stiffness --robot "$robot" --quiet "$data/kr360-loads.csv" -o /dev/full
check "nothing was written" test ! -e result.json
