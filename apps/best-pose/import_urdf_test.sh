#!/usr/bin/env bash
# scripts/import-urdf: the robot document moves as the URDF does; what cannot be one is refused.
. "$SOURCE/apps/testing.sh"
import=$SOURCE/scripts/import-urdf urdf=$data/six-axis.urdf
"$import" "$urdf" -o robot.json 2>.err
check "the chosen tip is said" grep -q '^import-urdf: .*six-axis.urdf: from link base_link to link tool0 (--base and --tip choose others)' .err
check_jq "six joints, limits in degrees" robot.json '(.joints | length) == 6 and (.joints[0].max_deg - 3.2 * 180 / 3.14159265358979 | fabs) < 1e-6'
echo '{"format": "stablecut/joint-stiffness/1", "stiffness_n_m_per_rad": [1e6, 1e6, 1e6, 1e6, 1e6, 1e6]}' >k.json
# Tool points by an independent composition of the URDF's frames.
cat >poses.json <<'END'
{"format": "stablecut/pose-list/1", "poses": [{"joints_deg": [0, 0, 0, 0, 0, 0]}, {"joints_deg": [10, -60, 50, 30, 40, 70]},
 {"joints_deg": [-100, 20, -40, -130, -70, 200]}]}
END
best-pose --robot robot.json --quiet --evaluate poses.json k.json -o scored.json
check_jq "the tool point goes where the URDF says" scored.json '[[.evaluated[].tcp_mm | .[]], [2740, 0, 634, 2075.56461641, -444.30247944,
  1704.55440931, -265.90559169, 2502.92867222, 477.02126953]] | transpose | length == 9 and all(.[0] - .[1] | fabs < 1e-6)'
check "a search runs on it" best-pose --robot robot.json --height 900 k.json -o best.json
"$import" --tip flange <"$urdf" >flange.json 2>.err
check "a tip that was given needs no word" test ! -s .err
check_jq "another tip" flange.json '.flange.rotation != $robot[0].flange.rotation' --slurpfile robot robot.json

# Rounded right angles, and a wrist that nearly meets, are what they stand for.
sed 's/1.57079632679/1.5708/; /joint_a4/s/rpy="0 0 0"/rpy="0 -0.0000036732 0"/; s/xyz="0 0 0.675" rpy="0 0 0"/xyz="0 0 0.675" rpy="3.14159 0 0"/' "$urdf" >rounded.urdf
"$import" rounded.urdf -o rounded.json 2>.err
check "a warning says so" grep -q '^import-urdf: warning: rounded.urdf: angles up to .* made right' .err
check_jq "right angles" rounded.json '[.joints[].alpha_deg] | all(. % 90 == 0 and . == floor)'
check "a search runs on them" best-pose --robot rounded.json --height=-900 k.json -o best.json
# A fixed last link belongs to the chain; a world below base_link does not.
sed 's/link name="tool0"/link name="hand"/; s/child link="tool0"/child link="hand"/; s/link name="flange"/link name="plate"/; s/link="flange"/link="plate"/
  s/<joint name="fix" type="fixed">/<joint name="fix" type="fixed"><origin xyz="1 2 0.5" rpy="0 0 1"\/>/' "$urdf" >world.urdf
"$import" world.urdf -o world.json 2>.err
check_jq "the same robot" world.json '.joints == $robot[0].joints and .flange == $robot[0].flange' --slurpfile robot robot.json

# A first axis off the base link's origin, a gripper behind the flange, wrist axes that miss each other by 5 um.
sed 's/xyz="0 0 0.675" rpy="0 0 0"/xyz="-0.00262 0.000976 0.675" rpy="0 0 0"/' "$urdf" >off.urdf
"$import" off.urdf -o off.json 2>.err
check_jq "the base takes up what axis 1 is off" off.json '.base.translation_mm == [-2.62, 0.976, 0] and .joints[0].a_mm == 0 and
  ([.joints[1:] , $robot[0].joints[1:]] | .[0] == .[1])' --slurpfile robot robot.json
check "a search runs on it" best-pose --robot off.json --height 900 k.json -o best.json
sed 's/<.robot>/<link name="finger"\/><joint name="grip" type="prismatic"><parent link="tool0"\/><child link="finger"\/><\/joint><\/robot>/' "$urdf" >gripper.urdf
"$import" gripper.urdf -o gripper.json 2>.err
check_jq "a gripper is not the tip" gripper.json '.joints == $robot[0].joints and .flange == $robot[0].flange' --slurpfile robot robot.json
sed '/joint_a5/s/xyz="0 0 0"/xyz="0 0 0.000005"/' "$urdf" >near.urdf
"$import" near.urdf -o near.json 2>.err
check "a wrist that nearly meets is said" grep -q '^import-urdf: warning: near.urdf: wrist axes up to 5.0e-03 mm apart were made to meet' .err
check_jq "and meets" near.json '.joints[4].a_mm == 0 and .joints[5].a_mm == 0 and .joints[4].d_mm == 0'
sed 's/<link name="l3"\/>/<link name="l3"><collision><geometry><mesh filename="a.stl"\/><\/geometry><\/collision><\/link>/' "$urdf" >mesh.urdf
"$import" mesh.urdf 2>.err >mesh.json
check "meshes are left out, and said" grep -q '^import-urdf: warning: mesh.urdf: collision shapes of the kind mesh are left out: 1 of them' .err

# Couplings: a rod that holds the elbow, and axis 3 from the horizontal.
mimic='<mimic joint="joint_a2" multiplier="-1"\/><parent link="l2"\/>' elbow='<link name="elbow"\/><joint name="rod" type="revolute">'
sed "s/<joint name=\"joint_a3\"/$elbow$mimic<child link=\"elbow\"\/><origin xyz=\"1.15 0 0\"\/><axis xyz=\"0 1 0\"\/><\/joint>&/
  /joint_a3/{s/parent link=\"l2\"\/><child link=\"l3\"\/><origin xyz=\"1.15 0 0\"/parent link=\"elbow\"\/><child link=\"l3\"\/><origin xyz=\"0 0 0\"/}" "$urdf" >rod.urdf
"$import" rod.urdf -o rod.json 2>.err
check_jq "a mimic joint on the axis of another is a coupling" rod.json '.coupling == [{joint: "joint_a3", follows: "joint_a2", ratio: -1}] and .joints == $robot[0].joints' --slurpfile robot robot.json
"$import" --coupling fanuc "$urdf" -o horizontal.json 2>.err
check_jq "axis 3 from the horizontal" horizontal.json '.coupling == [{joint: "joint_a3", follows: "joint_a2", ratio: -1}] and
  .joints[2].coupled_min_deg == $robot[0].joints[2].min_deg and .joints[2].coupled_max_deg == $robot[0].joints[2].max_deg and
  (.joints[2].max_deg - .joints[2].coupled_max_deg - .joints[1].max_deg | fabs) < 1e-6' --slurpfile robot robot.json
refused 65 'joint joint_a3: follows joint_a2 already: expected no --coupling' "$import" --coupling fanuc rod.urdf
refused 64 '^import-urdf: argument --coupling: .*nonsense' "$import" --coupling nonsense "$urdf"
sed 's/<child link="l3"\/><origin xyz="0 0 0"/<child link="l3"\/><origin xyz="0 0 0.1"/' rod.urdf >skew.urdf
refused 65 'mimic of joint_a2: expected on the axis of one joint with a drive of its own' "$import" skew.urdf

bad_urdf() {
  sed "$1" "$urdf" >bad.urdf
  refused 65 "^import-urdf: bad.urdf: $2" "$import" bad.urdf -o result.json
}
bad_urdf 's/name="joint_a3" type="revolute"/name="joint_a3" type="prismatic"/' 'joint joint_a3: type "prismatic": expected revolute'
bad_urdf 's/name="joint_a3" type="revolute"/name="joint_a3" type="fixed"/' '5 moving joints .*: expected 6'
bad_urdf 's/xyz="0.35 0 0"/xyz="0.35 0"/' 'joint joint_a2/origin/xyz: "0.35 0": expected 3 numbers'
bad_urdf '/joint_a4/s/lower="-6.1" //' 'joint joint_a4/limit: missing: expected lower and upper'
bad_urdf 's/<robot name/<robot xmlns:xacro="http:\/\/ros.org\/wiki\/xacro" name/; s/<.robot>/<xacro:six prefix=""\/><\/robot>/' 'a xacro file: expected URDF, which `xacro FILE` makes of it'
bad_urdf 's/xyz="0.35 0 0"/xyz="${a1} 0 0"/' 'a xacro file'
bad_urdf 's/<.robot>/<xacro:six prefix=""\/><\/robot>/' 'a xacro file'
bad_urdf 's/<robot/<machine/; s/<.robot/<\/machine/' '<machine>: expected <robot>'
bad_urdf 's/<.robot>//' 'line [0-9]+: expected XML'
refused 65 '^import-urdf: .*link nowhere: expected one of' "$import" --tip nowhere "$urdf"
refused 66 '^import-urdf: none.urdf: cannot be read' "$import" none.urdf
refused 64 '^import-urdf: .*--nonsense' "$import" --nonsense
refused 73 '^import-urdf: none/robot.json: cannot be created' "$import" "$urdf" -o none/robot.json
refused 74 '^import-urdf: <stdout>: cannot be written' bash -c '"$0" "$1" >/dev/full' "$import" "$urdf"
(umask 027; "$import" "$urdf" -o mine.json 2>.err)
check "the umask holds" test "$(stat -c %a mine.json)" = 640
"$import" "$urdf" -o /dev/null 2>.err
check "a device stays one" test -c /dev/null
check "nothing was written" test ! -e result.json -a -z "$(find . -name '.import-urdf-*')"
