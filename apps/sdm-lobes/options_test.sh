#!/usr/bin/env bash
# Options of sdm-lobes: each does what it says, and what should not change the result does not.
. "$SOURCE/apps/testing.sh"
table=$data/thesis-table-6-2.json cut=$data/thesis-cut.json
small=(--speed 8000:20000:7 --depth 0:3:9)

same_for_every_tool sdm-lobes lobes --cut "$cut"

sdm-lobes "$table" --cut "$cut" "${small[@]}" -o one.json --threads 1
sdm-lobes --cut "$cut" "${small[@]}" -o two.json --threads 2 <"$table"
check_jq "grid is [depth][speed]" one.json '(.spectral_radius | length == 9) and (.spectral_radius[0] | length == 7)'
check_jq "limit has a row per speed" one.json '[.limit[].speed_rpm] == .speed_rpm'
check_jq "limit agrees with the grid" one.json '. as $d | [range(7)] | all(. as $s
  | ($d.limit[$s].depth_mm // 99) as $limit | [range(9)] | all(($d.depth_mm[.] < $limit) == ($d.spectral_radius[.][$s] <= 1)
    or $d.depth_mm[.] > $limit))'
check "same bytes with 1 and 2 threads" cmp <(jq 'del(.provenance)' one.json) <(jq 'del(.provenance)' two.json)
check_jq "provenance: tool, hash, result arguments only" one.json '.provenance | .tool == "sdm-lobes"
  and (.inputs | length == 2) and (.inputs[1].sha256 == $sha) and (.arguments | index("--threads") == null)
  and (.arguments | index("--speed") != null)' --arg sha "$(sha256sum "$table" | cut -d' ' -f1)"
sdm-lobes "$table" --cut "$cut" "${small[@]}" --no-provenance -o plain.json
check_jq "no provenance on request" plain.json 'has("provenance") | not'

sdm-lobes "$table" --cut "$cut" "${small[@]}" --limit-only -o limit.json
check_jq "limit only: no grid" limit.json 'has("spectral_radius") | not'
check_jq "limit only: the same limit" limit.json '[.limit, $one[0].limit] | transpose
  | all(((.[0].depth_mm // 0) - (.[1].depth_mm // 0)) | fabs < 1e-6)' --slurpfile one one.json

sdm-lobes "$table" --teeth 2 --kt 689 --kr 267 --milling up --immersion 0.25 "${small[@]}" -o options.json
check "a cut by options is the cut by document" cmp <(jq .spectral_radius one.json) <(jq .spectral_radius options.json)
sdm-lobes "$table" --cut "$cut" --kt 900 --immersion 0.5 "${small[@]}" -o changed.json
jq '.kt_n_per_mm2 = 900 | .radial_immersion = 0.5' "$cut" >changed-cut.json
sdm-lobes "$table" --cut changed-cut.json "${small[@]}" -o by-document.json
check "an option stands in the place of the document's field" cmp <(jq 'del(.provenance)' changed.json) <(jq 'del(.provenance)' by-document.json)
jq 'del(.milling, .radial_immersion) | .entry_deg = 0 | .exit_deg = 60' "$cut" >angles.json
sdm-lobes "$table" --cut angles.json "${small[@]}" -o angles-out.json
check_jq "a cut by angles is the cut by immersion" angles-out.json '[.spectral_radius, $one[0].spectral_radius]
  | map(flatten) | transpose | all((.[0] - .[1]) | fabs < 1e-9)' --slurpfile one one.json
sdm-lobes "$table" --cut angles.json --milling up --immersion 0.25 "${small[@]}" -o arc.json
check "and in the place of its angles" cmp <(jq .spectral_radius one.json) <(jq .spectral_radius arc.json)
refused 65 "^sdm-lobes: angles.json: /milling: missing" sdm-lobes "$table" --cut angles.json --immersion 0.25 "${small[@]}"
jq '.feed_angle_deg = 360' "$cut" >turned.json
sdm-lobes "$table" --cut turned.json "${small[@]}" -o turned-out.json
check_jq "a full turn of the feed changes nothing" turned-out.json '[.spectral_radius, $one[0].spectral_radius]
  | map(flatten) | transpose | all((.[0] - .[1]) | fabs < 1e-9)' --slurpfile one one.json

sdm-lobes "$table" --cut "$cut" --speed 9000:12000:3 --depth 0:3:5 --modes 14,15 --per-mode -o modes.json
check_jq "per mode: a limit curve each" modes.json '[.per_mode[].mode] == [14, 15] and all(.per_mode[].limit; length == 3)'
sdm-lobes "$table" --cut "$cut" --speed 9000:12000:3 --depth 0:3:5 --modes 15 -o alone.json
check_jq "per mode: the limit of that mode alone" modes.json '[.per_mode[1].limit, $alone[0].limit] | transpose
  | all(((.[0].depth_mm // 0) - (.[1].depth_mm // 0)) | fabs < 1e-6)' --slurpfile alone alone.json

check_jq "modes are named as in the table" modes.json '[.crossings[].mode] | length > 0 and all(. == 14 or . == 15)'

check_jq "every limit is the lowest crossing" one.json '. as $d | [.limit[] | select(.depth_mm)] | length > 0 and all(. as $l
  | [$d.crossings[] | select(.speed_rpm == $l.speed_rpm)][0] | .depth_mm == $l.depth_mm and .above == "unstable")'
check_jq "what drives a lobe" one.json '[.crossings[]] | length > 0 and all(.mode >= 1 and .mode <= 15 and .participation > 0.1
  and .lobe == (.chatter_frequency_hz * 60 / (2 * .speed_rpm) | floor))'

jq '.modes |= .[:8]' "$table" >soft.json
sdm-lobes soft.json "$table" --cut "$cut" "${small[@]}" -o both.json
sdm-lobes soft.json --cut "$cut" "${small[@]}" -o soft-out.json
check_jq "several tables: the lowest limit, and whose it is" both.json '.tables == ["soft.json", $name]
  and ([.limit, $one[0].limit, $soft[0].limit] | transpose | all(.[0].depth_mm == ([.[1].depth_mm, .[2].depth_mm | select(.)] | min)
    and (.[0].depth_mm == null or (.[0].table == 2) == (.[0].depth_mm == .[1].depth_mm))))' \
  --arg name "$table" --slurpfile one one.json --slurpfile soft soft-out.json
check_jq "several tables: the largest radius" both.json '[.spectral_radius, $one[0].spectral_radius, $soft[0].spectral_radius]
  | map(flatten) | transpose | all(.[0] == ([.[1], .[2]] | max))' --slurpfile one one.json --slurpfile soft soft-out.json
refused 64 "^sdm-lobes: .*expected with one modal table only" sdm-lobes soft.json "$table" --cut "$cut" --per-mode

# A mode of 100 kHz turns too often in one cut at low speed.
jq '.modes = [.modes[14] | .frequency_hz = 1e5]' "$table" >fast.json
sdm-lobes fast.json --cut "$cut" --speed 600:120600:3 --depth 0:2:3 -o part.json 2>part.err
check_jq "a speed that cannot be resolved is unknown, and the others are there" part.json '(.limit | length == 3)
  and (.limit[0] | .not_resolved and .depth_mm == null) and (.limit[1:] | all(.not_resolved == null))
  and (.spectral_radius | all(.[0] == null and .[1] > 0))'
check "and there is a warning" grep -q "at 600 rpm the fastest mode turns too often.*without a limit: 1" part.err
refused 1 "at 600 rpm the fastest mode turns too often" sdm-lobes fast.json --cut "$cut" --speed 600:700:2 -o none.json

jq '.feed_per_tooth_mm = 0.05' "$cut" >feed.json
sdm-lobes "$table" --cut feed.json --speed 8000:20000:61 --depth 0:3:2 --limit-only -o run.json
check_jq "stable at every speed: below the whole curve" run.json '. as $d | .what_to_run.unconditional.depth_mm
  | . > 0 and . <= ([$d.limit[].depth_mm | select(.)] | min)'
check_jq "stable at every speed is the lowest of the drawn curve" run.json '.what_to_run as $w | $w.unconditional.depth_mm
  == ([.limit[].depth_mm, $w.limit_between[].depth_mm | select(.)] | min)'
check_jq "a best point at the chart's edge says so" run.json '. as $d | .what_to_run.best | all((.at_chart_edge == true)
  == (.speed_rpm * 1.02 > $d.speed_rpm[-1] or .speed_rpm * 0.98 < $d.speed_rpm[0]))'
check_jq "best points: inside their margins, best first" run.json '. as $d | .what_to_run.best | length > 1
  and all(. as $p | $p.depth_mm <= 0.9 * ($p.limit_mm // 4) + 1e-12 and ($d.limit | all((.depth_mm // 4) >= $p.depth_mm
    or .speed_rpm <= ($p.slowest_rpm // 0) or .speed_rpm >= ($p.fastest_rpm // 1e9))))
  and ([.[].removal_of_best] | . == (sort | reverse) and .[0] == 1)'
check_jq "power is Kt times the removal rate" run.json '.what_to_run.best
  | length > 0 and all((.power_w - 689 * .removal_cm3_per_min * 1000 / 60 / 1000) | fabs < 1e-6)'
sdm-lobes "$table" --cut feed.json --speed 8000:20000:61 --depth 0:3:2 --limit-only --max-power 40 --max-torque 0.03 --best 2 -o most.json
check_jq "limits of power and torque" most.json '.what_to_run.best | length == 2 and all(.power_w <= 40.0001 and .torque_n_m <= 0.030001)'

for part in 1 2 3; do sdm-lobes "$table" --cut "$cut" "${small[@]}" --shard $part/3 -o part$part.json; done
sdm-lobes "$table" --cut "$cut" "${small[@]}" --merge part3.json --merge part1.json --merge part2.json -o merged.json
check "parts merge to the bytes of one run" cmp one.json merged.json
jq '.kt_std_n_per_mm2 = 30 | .kr_std_n_per_mm2 = 20' "$cut" >sure.json
sampled=(sdm-lobes "$table" --cut sure.json "${small[@]}" --samples 20)
"${sampled[@]}" -o sampled.json
check_jq "probability: 1 at no depth, falling to 0 where the limit is passed by far" sampled.json '. as $d
  | (.probability_stable[0] | all(. == 1)) and ([.probability_stable | flatten[] | select(. > 0 and . < 1)] | length > 0)
  and (.limit | all(.interval_95_mm[0] == null or .interval_95_mm[0] <= (.depth_mm // 3)))'
for part in 1 2; do "${sampled[@]}" --shard $part/2 -o part$part.json; done
"${sampled[@]}" --merge part1.json --merge part2.json -o merged.json
check "parts with samples too" cmp sampled.json merged.json
"${sampled[@]}" --threads 1 -o single.json
check "samples: same bytes with 1 and 2 threads" cmp sampled.json single.json
sdm-lobes "$table" --cut "$cut" "${small[@]}" --samples 2 2>said -o nothing.json
check "samples of nothing: said" grep -q 'warning: --samples: neither a covariance' said

# What stable cuts leave on the part.
jq '.feed_per_tooth_mm = 0.1 | .diameter_mm = 12 | .kte_n_per_mm = 15 | .kre_n_per_mm = 20' "$cut" >fed.json
sdm-lobes "$table" --cut fed.json "${small[@]}" --surface -o surface.json
check_jq "a surface where the cut is stable, and only there" surface.json '[.spectral_radius, .surface.peak_vibration_um]
  | map(flatten) | transpose | all((.[0] < 1) == (.[1] != null)) and any(.[1] != null)'
check_jq "straight teeth: in proportion to the depth" surface.json '. as $d | .surface | [.location_error_um, .rms_vibration_um, .mean_normal_um]
  | all(. as $g | [range($d.speed_rpm | length)] | all(. as $s | [range($d.depth_mm | length)
    | select($d.depth_mm[.] > 0 and $g[.][$s] != null) | $g[.][$s] / $d.depth_mm[.]] | length < 2 or (max - min | fabs) < 1e-9 * (max | fabs)))'
# Teeth that hardly differ leave hardly another surface, by another way of computing it.
for change in '.runout_um = [1e-4, -1e-4]' '.pitch_deg = [179.9999, 180.0001]' '.process_damping_n_per_m = 1e-3'; do
  jq "$change" fed.json >alike.json
  sdm-lobes "$table" --cut alike.json "${small[@]}" --surface -o alike-out.json
  check_jq "hardly $change is none" alike-out.json '[.surface, $one[0].surface] | [.[] | [.location_error_um, .rms_vibration_um, .mean_normal_um]]
    | . as $g | [$g[] | flatten] | transpose | map(select(.[0] != null and .[1] != null)) | length > 3 and (($g[1] | flatten | map(select(. != null) | fabs) | max) as $most
    | all((.[0] - .[1] | fabs) < 1e-3 * $most))' --slurpfile one surface.json
done
for option in --surface '--max-surface-error 20'; do
  # shellcheck disable=SC2086
  refused 64 "${option%% *}: expected feed_per_tooth_mm" sdm-lobes "$table" --cut "$cut" "${small[@]}" $option
done
refused 64 '--surface: expected with one modal table only' sdm-lobes "$table" "$table" --cut fed.json "${small[@]}" --surface
sdm-lobes "$table" --cut fed.json "${small[@]}" --limit-only --max-surface-error 6 -o bounded.json
check_jq "the best points leave an allowed surface" bounded.json '.what_to_run.best | length > 0 and all(.surface.location_error_um | fabs <= 6.0001)'
check_jq "which others do not" surface.json '.what_to_run.best | any(.surface.location_error_um | fabs > 6.0001)'
jq -n '{format: "stablecut/pose/1", evaluated: [{compliance_um_per_n: [[0.5, 0.1, 0], [0.1, 0.3, 0], [0, 0, 0.2]]}]}' >pose.json
sdm-lobes "$table" --cut fed.json "${small[@]}" --limit-only --max-surface-error 1e9 -o without.json
for angle in 0 90; do
  sdm-lobes "$table" --cut fed.json "${small[@]}" --limit-only --max-surface-error 1e9 --static pose.json --static-angle $angle -o static-$angle.json
done
# By how much the pose moves the tip of the first point on, from the same mean force; the taps' z is against the tool's.
check_jq "a pose's compliance under the mean force, in the frame of the taps" static-0.json '
  def moved: [.what_to_run.best[0].surface | .mean_feed_um, .mean_normal_um];
  (moved) as $a | ($turned[0] | moved) as $b | ($none[0] | moved) as $n
  | [$a[0] - $n[0], $a[1] - $n[1]] as $p | [$b[0] - $n[0], $b[1] - $n[1]] as $q
  # C at 0: [[0.5, -0.1], [-0.1, 0.3]], at 90: [[0.3, 0.1], [0.1, 0.5]].
  | ((0.3 * $p[0] + 0.1 * $p[1]) / 0.14) as $x | ((0.1 * $p[0] + 0.5 * $p[1]) / 0.14) as $y
  | (0.3 * $x + 0.1 * $y - $q[0] | fabs) < 1e-9 and (0.1 * $x + 0.5 * $y - $q[1] | fabs) < 1e-9 and ($x | fabs) > 1' --slurpfile turned static-90.json --slurpfile none without.json
refused 64 '--static: expected with --surface' sdm-lobes "$table" --cut fed.json --static pose.json
refused 64 '--static-angle: expected with --static' sdm-lobes "$table" --cut fed.json --surface --static-angle 3
jq '.evaluated += .evaluated' pose.json >two-poses.json
refused 65 'two-poses.json: /evaluated: a list of 2: expected one pose' sdm-lobes "$table" --cut fed.json --surface --static two-poses.json
jq 'del(.evaluated[0].compliance_um_per_n[2])' pose.json >short-pose.json
refused 65 'short-pose.json: /evaluated/0/compliance_um_per_n' sdm-lobes "$table" --cut fed.json --surface --static short-pose.json
refused 64 '--surface: expected a chart with its grid' sdm-lobes "$table" --cut fed.json --surface --limit-only
jq '.runout_um = [1, 2, 3]' fed.json >refused.json
refused 65 '/runout_um: a list of 3: expected 2 numbers, one for each tooth' sdm-lobes "$table" --cut refused.json "${small[@]}"

# The axis: a mode along z that a lead angle couples in; without one it is left out.
jq '.dofs += ["z"] | .modes[] |= (.psi_r += [.psi_r[0]] | .psi_l += [.psi_l[0]])' "$table" >axial-table.json
sdm-lobes axial-table.json --cut "$cut" "${small[@]}" -o upright.json 2>said
check "z without a force along it: said" grep -q '"z": left out: this cut does not act along the axis' said
check_jq "and the chart is that of the plane" upright.json '.spectral_radius == $one[0].spectral_radius' --slurpfile one one.json
jq '.lead_angle_deg = 45 | .ka_n_per_mm2 = 100' "$cut" >inclined.json
sdm-lobes axial-table.json --cut inclined.json "${small[@]}" -o inclined-out.json 2>said
check "z that takes part: nothing to say" test ! -s said
sdm-lobes "$table" --cut inclined.json "${small[@]}" -o plane.json
check_jq "the axis matters" inclined-out.json '.spectral_radius != $plane[0].spectral_radius' --slurpfile plane plane.json
jq '.corner_radius_mm = 1e-7' inclined.json >corner.json
sdm-lobes axial-table.json --cut corner.json "${small[@]}" -o corner-out.json
check_jq "hardly a corner is none" corner-out.json '[.spectral_radius, $one[0].spectral_radius]
  | map(flatten) | transpose | all((.[0] - .[1]) | fabs < 1e-6)' --slurpfile one inclined-out.json
jq '.lead_angle_deg = 91' "$cut" >wrong.json
refused 65 'wrong.json: /lead_angle_deg: 91: expected a lead angle' sdm-lobes "$table" --cut wrong.json "${small[@]}"

# An edge twice as steep as the other hardly matters where both are hardly inclined.
jq '.helix_deg = [1e-7, 2e-7]' "$cut" >listed.json
sdm-lobes "$table" --cut listed.json --speed 9000:9000:1 --depth 0:2:3 --quiet -o listed-out.json
sdm-lobes "$table" --cut "$cut" --speed 9000:9000:1 --depth 0:2:3 --quiet -o straight-out.json
check_jq "helices that hardly differ are none" listed-out.json '[.spectral_radius[][], .limit[0].depth_mm] as $a
  | [$one[0].spectral_radius[][], $one[0].limit[0].depth_mm] as $b | [$a, $b] | transpose | all(.[0] - .[1] | fabs < 1e-5)' \
  --slurpfile one straight-out.json
jq '.helix_deg = 1e-7 | .pitch_deg = [180, 180]' "$cut" >plain.json
sdm-lobes "$table" --cut plain.json "${small[@]}" -o plain-out.json
check_jq "hardly any helix is none" plain-out.json '[.spectral_radius, $one[0].spectral_radius]
  | map(flatten) | transpose | all((.[0] - .[1]) | fabs < 1e-6)' --slurpfile one one.json
jq '.pitch_deg = [179.9999, 180.0001]' "$cut" >uneven.json
sdm-lobes "$table" --cut uneven.json "${small[@]}" -o uneven-out.json
check_jq "hardly uneven pitches are equal" uneven-out.json '[.spectral_radius, $one[0].spectral_radius]
  | map(flatten) | transpose | all((.[0] - .[1]) | fabs < 1e-4)' --slurpfile one one.json
jq '.modes = [{frequency_hz: 922, damping_ratio: 0.011, psi_r: [[1, 0], [0, 0]], psi_l: [[0, -0.00216], [0, 0]]}]' "$table" >mode.json
jq '.process_damping_n_per_m = 3e4 | .process_damping_friction = 0.3' "$cut" >damped.json
for document in $cut damped.json; do sdm-lobes mode.json --cut $document --speed 1500:2000:2 --depth 0:30:2 --limit-only; done |
  jq -s '[.[].limit | map(.depth_mm // 30) | min]' >limits.json
check_jq "process damping raises the lowest limit" limits.json '.[1] > 1.1 * .[0]'

jq 'del(.chart)' "$cut" >nochart.json
sdm-lobes "$table" --cut nochart.json --modes 15 -o default.json
check_jq "64 by 64 when nothing says the chart" default.json '(.speed_rpm | length == 64) and (.depth_mm | length == 64)'

echo '[{"depth_mm": 1, "speed_rpm": 20000}, {"depth_mm": 2, "speed_rpm": 5000, "observed": "chatter"}]' >points.json
sdm-lobes "$table" --cut "$cut" --speed 9000:9000:1 --depth 1:1:1 --points points.json -o judged.json
check_jq "points from JSON" judged.json '.points[0].stable and (.points[0] | has("agrees") | not) and .points[1].agrees'

jq '.dofs = ["x"] | .modes |= map(.psi_r |= .[:1] | .psi_l |= .[:1])' "$table" >x.json
sdm-lobes x.json --cut "$cut" "${small[@]}" -o x-out.json
check "one direction runs" test $? -eq 0
jq '.modes |= map(.psi_r[1] = [0, 0] | .psi_l[1] = [0, 0])' "$table" >x-rigid-y.json
sdm-lobes x-rigid-y.json --cut "$cut" "${small[@]}" -o x-rigid-y-out.json
check_jq "one direction is two with the other rigid" x-out.json '[.spectral_radius, $two[0].spectral_radius]
  | map(flatten) | transpose | all((.[0] - .[1]) | fabs < 1e-9)' --slurpfile two x-rigid-y-out.json

sdm-lobes "$table" --cut "$cut" "${small[@]}" | head -c 100 >/dev/null
status=("${PIPESTATUS[@]}")
check "a reader that leaves early ends the tool quietly" test "${status[0]}" -eq 141 -o "${status[0]}" -eq 0

# Critical modes that the measurement hardly knows are named.
doubt() { # TEXT FILTER: the table changed by a jq filter
  jq "$2" "$table" >doubtful.json
  sdm-lobes doubtful.json --cut "$cut" "${small[@]}" --limit-only -o out.json 2>err
  check "$2: $1, not $(cat err)" grep -Eq "^sdm-lobes: warning: mode [0-9]+ \\([0-9.e+]+ Hz\\) limits the depth down to [0-9.e-]+ mm, but $1" err
}
doubt 'lies outside the measured band' '.modes[].out_of_band = true'
doubt 'has a damping ratio of 1e-06, as no structure has' '.modes[9].damping_ratio = 1e-6'
check "the depth without it: said, not $(cat err)" grep -Eq '^sdm-lobes: warning: the other modes alone \(--modes 1-9,11-15\) limit the depth down to [0-9.]+ mm$' err
said=$(sed -n 's/.* alone .* down to \(.*\) mm$/\1/p' err)
sdm-lobes doubtful.json --modes 1-9,11-15 --cut "$cut" "${small[@]}" --limit-only -o out.json
check_jq "it is what --modes gives" out.json '([.limit[].depth_mm | numbers] | min) / $said | . > 0.99 and . < 1.01' --argjson said "$said"
sdm-lobes "$table" --cut "$cut" "${small[@]}" --limit-only -o out.json 2>err
check "nothing is said of the others, not $(cat err)" test ! -s err

# A radial coefficient that is written as its share of the tangential one.
jq '.kr_n_per_mm2 = 0.3' "$cut" >ratio.json
sdm-lobes "$table" --cut ratio.json "${small[@]}" --limit-only -o out.json 2>err
check "a ratio Kr/Kt: said, not $(cat err)" grep -q '^sdm-lobes: warning: ratio.json: /kr_n_per_mm2: 0.3: .*a ratio Kr/Kt' err

# In Pa, or in GPa.
for kt in 6.89e8 0.689; do
  jq --argjson kt "$kt" '.kt_n_per_mm2 = $kt | .kr_n_per_mm2 = 0.4 * $kt' "$cut" >unit.json
  sdm-lobes "$table" --cut unit.json --speed 9000:9000:1 --depth 0:0.001:2 --limit-only -o out.json 2>err
  check "Kt of $kt: said, not $(cat err)" grep -q '^sdm-lobes: warning: unit.json: /kt_n_per_mm2: .*: of no material that is milled' err
done

# A chart a hundred thousand times above its limits: no number of points gives the radii, but stable or not is sure.
fit-modes --quiet "$data/taps/four.csv" -o soft.json
sdm-lobes soft.json --cut "$cut" --depth 0:5:20 --speed 8000:16000:3 --best 0 -o far.json 2>err
check "an error above the radius: said, not $(cat err)" grep -q '^sdm-lobes: warning: the spectral radius has converged only to .* of max(1, radius)' err
check_jq "every radius that is stated is on the side of 1 that the limit says" far.json '. as $l |
  [range(0; 3) as $s | range(0; 20) as $d | $l.spectral_radius[$d][$s] | numbers | (. > 1) == ($l.depth_mm[$d] > $l.limit[$s].depth_mm)] |
  length > 0 and all'
