#!/usr/bin/env bash
# scripts/import-urdf: the robot document moves as the URDF does; what cannot be one is refused.
. "$SOURCE/apps/testing.sh"
import=$SOURCE/scripts/import-urdf urdf=$data/six-axis.urdf
"$import" "$urdf" -o robot.json
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
"$import" --tip flange <"$urdf" >flange.json
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
"$import" world.urdf -o world.json
check_jq "the same robot" world.json '.joints == $robot[0].joints and .flange == $robot[0].flange' --slurpfile robot robot.json

bad_urdf() {
  sed "$1" "$urdf" >bad.urdf
  refused 65 "^import-urdf: bad.urdf: $2" "$import" bad.urdf -o result.json
}
bad_urdf 's/name="joint_a3" type="revolute"/name="joint_a3" type="prismatic"/' 'joint joint_a3: type "prismatic": expected revolute'
bad_urdf 's/name="joint_a3" type="revolute"/name="joint_a3" type="fixed"/' '5 moving joints .*: expected 6'
bad_urdf 's/xyz="0.35 0 0"/xyz="0.35 0"/' 'joint joint_a2/origin/xyz: "0.35 0": expected 3 numbers'
bad_urdf '/joint_a4/s/lower="-6.1" //' 'joint joint_a4/limit: missing: expected lower and upper'
bad_urdf 's/xyz="0 0 0.675" rpy="0 0 0"/xyz="0 0.1 0.675" rpy="0 0 0"/' 'joint joint_a1: expected an axis that meets the base'
bad_urdf 's/<robot/<machine/; s/<.robot/<\/machine/' '<machine>: expected <robot>'
bad_urdf 's/<.robot>//' 'line [0-9]+: expected XML'
refused 65 '^import-urdf: .*link nowhere: expected one of' "$import" --tip nowhere "$urdf"
refused 66 '^import-urdf: none.urdf: cannot be read' "$import" none.urdf
refused 64 '^import-urdf: .*--nonsense' "$import" --nonsense
refused 73 '^import-urdf: none/robot.json: cannot be created' "$import" "$urdf" -o none/robot.json
refused 74 '^import-urdf: <stdout>: cannot be written' bash -c '"$0" "$1" >/dev/full' "$import" "$urdf"
(umask 027; "$import" "$urdf" -o mine.json)
check "the umask holds" test "$(stat -c %a mine.json)" = 640
"$import" "$urdf" -o /dev/null
check "a device stays one" test -c /dev/null
check "nothing was written" test ! -e result.json -a -z "$(find . -name '.import-urdf-*')"
