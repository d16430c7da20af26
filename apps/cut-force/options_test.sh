#!/usr/bin/env bash
# Options of cut-force: each does what it says, and what should not change the result does not.
. "$SOURCE/apps/testing.sh"
table=$data/thesis-table-6-2.json
jq '.feed_per_tooth_mm = 0.1 | .kte_n_per_mm = 15 | .kre_n_per_mm = 20 | .ka_n_per_mm2 = 100' "$data/thesis-cut.json" >cut.json

same_for_every_tool cut-force cut-force

cut-force cut.json -o force.json
check_jq "1 mm unless said, and no power without a speed" force.json '.depth_mm == 1 and .power_w == null and (has("points") | not)'
# Up milling to 60 degrees: the average force model by hand, sin cos = 3/8, sin^2 = pi/6 - sqrt(3)/8, sin = 1/2, cos = sqrt(3)/2.
check_jq "mean force" force.json '(4 * (1 | atan)) as $pi | ($pi / 6 - (3 | sqrt) / 8) as $ss | (1 / $pi) as $n
  | [-$n * (0.1 * (689 * 0.375 + 267 * $ss) + 15 * (3 | sqrt) / 2 + 20 / 2),
     $n * (0.1 * (689 * $ss - 267 * 0.375) + 15 / 2 - 20 * (3 | sqrt) / 2), $n * 0.1 * 100 / 2] as $by_hand
  | [.mean_force_n, $by_hand] | transpose | all((.[0] - .[1]) | fabs < 1e-9)'
check_jq "the wave's mean and peak are those said" force.json '((.wave.axial_n | add / length) / .mean_force_n[2] - 1 | fabs < 0.02)
  and ([.wave | [.feed_n, .normal_n, .axial_n] | transpose[] | map(. * .) | add | sqrt] | max) <= .peak_force_n * (1 + 1e-9)'
cut-force cut.json --depth 3 --speed 6000 --harmonics 4 -o deep.json
check_jq "straight teeth: in proportion to the depth" deep.json '(.peak_force_n / $one[0].peak_force_n - 3 | fabs) < 1e-9
  and (.torque_n_m / $one[0].torque_n_m - 3 | fabs) < 1e-9' --slurpfile one force.json
check_jq "power is torque times speed" deep.json '(.power_w / (.torque_n_m * 200 * 3.141592653589793) - 1 | fabs) < 1e-12'
check_jq "harmonics are multiples of the teeth" deep.json '[.harmonics[].per_revolution] == [2, 4, 6, 8] and [.harmonics[].frequency_hz] == [200, 400, 600, 800]'
jq '.helix_deg = 30' cut.json >helix.json
cut-force helix.json --depth 3 -o helix-out.json
check_jq "a helix leaves the mean and lowers the peak" helix-out.json '([.mean_force_n, $deep[0].mean_force_n] | transpose | all((.[0] - .[1]) | fabs < 1e-9))
  and .peak_force_n < 0.99 * $deep[0].peak_force_n' --slurpfile deep deep.json
jq '.helix_deg = [30, 30]' cut.json | cut-force --depth 3 --no-provenance | jq 'del(.cut)' >listed.json
check_jq "a list of one angle is that angle" listed.json '. == ($one[0] | del(.cut, .provenance))' --slurpfile one helix-out.json
jq '.helix_deg = [30, 40]' cut.json >variable.json
cut-force variable.json --depth 3 -o variable-out.json
check_jq "helices that differ leave the mean, and repeat by the revolution" variable-out.json '
  ([.mean_force_n, $deep[0].mean_force_n] | transpose | all((.[0] - .[1]) | fabs < 1e-9)) and .harmonics[0].per_revolution == 1' \
  --slurpfile deep deep.json
refused 1 'an edge comes up with the one before it .*: expected a smaller depth$' cut-force variable.json --depth 300

points=$data/thesis-table-6-3.csv
cut-force cut.json --table "$table" --points "$points" --threads 1 --passes 200 --quiet -o one.json
cut-force --table "$table" --points "$points" --threads 2 --passes 200 --quiet -o two.json <cut.json
check "same bytes with 1 and 2 threads" cmp <(jq 'del(.provenance)' one.json) <(jq 'del(.provenance)' two.json)
check_jq "provenance: tool, inputs, result arguments only" one.json '.provenance | .tool == "cut-force" and (.inputs | length == 3)
  and (.arguments | index("--threads") == null) and (.arguments | index("--passes") != null)'
sdm-lobes "$table" --cut cut.json --points "$points" --speed 9000:9000:1 --depth 1:1:1 -o lobes.json
check_jq "published cuts: the growth is the spectral radius" one.json '[.points, $lobes[0].points] | transpose | length == 21
  and all((.[0].growth_per_tooth / .[1].spectral_radius - 1 | fabs) < 1e-5 and .[0].agrees == .[1].agrees)' --slurpfile lobes lobes.json
check_jq "a settled motion has no chatter, and no contact is lost" one.json '[.points[] | select(.settled)] | length > 3
  and all(.chatter_frequency_hz == null and .without_contact == 0 and .stable)'
check_jq "chatter where it is clearly unstable" one.json '[.points[] | select(.growth_per_tooth > 1.05)] | length > 3
  and all((.settled | not) and .without_contact > 0.05) and ([.[].chatter_frequency_hz] | sort | .[length / 2 | floor] | . > 540 and . < 590)'
check_jq "samples: once per tooth" one.json 'all(.points[]; (.samples_um.feed | length) == 200 and (.samples_um.normal | length) == 200 and .teeth_followed == 200)'
printf 'depth_mm,speed_rpm\n1,20000\n' >point.csv
cut-force cut.json --table "$table" --points point.csv --steps 600 --quiet -o point.json
sdm-lobes "$table" --cut cut.json --speed 20000:20000:1 --depth 1:1:1 --surface -o surface.json
check_jq "the wall is where the forced vibration leaves it" point.json '.points[0].location_error_um / $s[0].surface.location_error_um[0][0] - 1 | fabs < 2e-3' \
  --slurpfile s surface.json
check_jq "steps as asked for" point.json '.points[0].steps_per_tooth >= 600'
cut-force cut.json --table "$table" --depth 1 --speed 20000 --quiet -o single.json
check_jq "a single point by --depth and --speed" single.json '(.points | length) == 1 and .points[0].speed_rpm == 20000 and .speed_rpm == 20000'
cut-force cut.json --table "$table" --points point.csv --from-rest --passes 100 --quiet -o rest.json
check_jq "from rest: the blow is still there after 100 teeth" rest.json '.points[0].settled | not'
check "is said" grep -q 'the motion has not settled' <(cut-force cut.json --table "$table" --points point.csv --from-rest --passes 100 2>&1 >/dev/null)

jq '.runout_um = [30, -30] | .pitch_deg = [170, 190]' cut.json >uneven.json
cut-force uneven.json --table "$table" --points point.csv --passes 60 --quiet -o uneven-out.json
check_jq "runout and unequal pitches" uneven-out.json '.harmonics[0].per_revolution == 1 and .points[0].growth_per_tooth > 0.9'

# A growth that its error leaves on both sides of 1 is no verdict, nor is that of a motion which is none of the cut.
printf 'depth_mm,speed_rpm\n1,20000\n1.5,15000\n' >open.csv
cut-force cut.json --table "$table" --points open.csv --passes 50 -o open.json 2>said
check_jq "the error reaches across 1" open.json '[.points[] | (.growth_per_tooth - 1 | fabs) <= .growth_error * .growth_per_tooth] == [false, true]'
check "and is said to" grep -q '^cut-force: warning: open.csv: at 1 points the growth is nearer to 1 than its error: whether they are stable is left open$' said
jq '.pitch_deg = [230, 130] | .feed_per_tooth_mm = 0.005' cut.json >thin.json
cut-force thin.json --table "$table" --depth 1 --speed 9000 --passes 20 -o thin-out.json 2>said
check_jq "a tooth would lose its thin chip" thin-out.json '.points[0].keeps_contact | not'
check "and is said to" grep -q 'at 1 points the motion whose growth is told would leave a tooth without its chip' said
