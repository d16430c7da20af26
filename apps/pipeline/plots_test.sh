#!/usr/bin/env bash
# The plot scripts: pictures of the right form, refusals like the tools'.
. "$SOURCE/apps/testing.sh"
scripts=$SOURCE/scripts
sdm-lobes "$data/thesis-table-6-2.json" --cut "$data/thesis-cut.json" --points "$data/thesis-table-6-3.csv" \
  --speed 5000:20000:12 --depth 0:4:9 -o lobes.json
fit-modes --synthesize 2:1000:200 "$data/thesis-table-6-2.json" -o frf.json
fit-modes --quiet --synthesize 2:1000:1000 "$data/thesis-table-6-2.json" | fit-modes --quiet --stabilization stabilization.json -o modes.json
robot=$data/kr360.json
jq '{format: "stablecut/joint-stiffness/1", stiffness_n_m_per_rad: .k_theta_2d_n_m_per_rad}' "$data/yanshan-poses.json" >k2d.json
best-pose --robot "$robot" --height 1600 --x=-2600:2600:14 --y=-2600:2600:14 --map pose-map.json k2d.json -o pose.json
jq -n '{format: "stablecut/tool-path/1", speed_mm_per_s: 100, frame: {translation_mm: [1800, 0, 1600], rotation: [[1, 0, 0], [0, 1, 0], [0, 0, 1]]},
  points: [range(21) | {position_mm: [0, . * 40 - 400, 0], axis: [0, 0, -1]}]}' >tool-path.json
best-pose --robot "$robot" --path tool-path.json --quiet k2d.json -o path.json
jq '.feed_per_tooth_mm = 0.1' "$data/thesis-cut.json" >fed.json
cut-force fed.json --depth 2 --speed 9000 --table "$data/thesis-table-6-2.json" --points "$data/thesis-table-6-3.csv" --passes 200 --quiet -o force.json
for plot in lobes frf pose-map stabilization path force; do
  for form in svg png pdf; do
    "$scripts/plot-$plot" $plot.json -o $plot.$form 2>.err
    check "plot-$plot to $form" test $? -eq 0 -a -s $plot.$form -a ! -s .err
  done
  check "plot-$plot: SVG" grep -q '</svg>' $plot.svg
  check "plot-$plot: PNG" test "$(head -c 4 $plot.png | tail -c 3)" = PNG
  check "plot-$plot: PDF" test "$(head -c 5 $plot.pdf)" = %PDF-
  "$scripts/plot-$plot" --terminal --size 70:20 <$plot.json >text 2>.err
  check "plot-$plot in a terminal, of that size" test "$(wc -l <text)" -ge 20 -a "$(awk 'length > 70' text | wc -l)" -eq 0 -a ! -s .err
  "$scripts/plot-$plot" --size=900:800 --title "a'b; system \"touch pwned\" \`touch pwned\` Maß" <$plot.json >titled.svg
  check "plot-$plot: size and title, from standard input" grep -q 'width="900" height="800"' titled.svg
  check "plot-$plot: the title without harm" grep -q '>a?b? system ?touch pwned? ?touch pwned? Maß<' titled.svg
  refused 64 "^plot-$plot: --nonsense: unknown option" "$scripts/plot-$plot" --nonsense
  refused 64 "^plot-$plot: --titel: unknown option: expected --title \(see plot-$plot --help\)" "$scripts/plot-$plot" --titel x
  refused 64 "^plot-$plot: x.jpg: expected a name that ends in .svg, .png or .pdf" "$scripts/plot-$plot" $plot.json -o x.jpg
  refused 64 "^plot-$plot: --size: 900: expected W:H" "$scripts/plot-$plot" --size 900 $plot.json
  refused 64 "^plot-$plot: --size: 200:200: expected more" "$scripts/plot-$plot" --size 200:200 $plot.json
  refused 66 "^plot-$plot: missing.json: cannot be read" "$scripts/plot-$plot" missing.json -o x.svg
  "$scripts/plot-$plot" --help >help
  check "plot-$plot --help: an example first, within 80 columns" test $? -eq 0 -a "$(head -n 1 help)" = Example: -a "$(awk 'length > 80' help | wc -l)" -eq 0
done
check "no command runs for a title" test ! -e pwned
for form in svg png pdf; do
  "$scripts/plot-lobes" lobes.json -o again.$form
  check "the same bytes again: $form" cmp -s lobes.$form again.$form
done
refused 74 '^plot-lobes: <stdout>: No space left' sh -c '"$1" "$2" >/dev/full' - "$scripts/plot-lobes" lobes.json
refused 64 '^plot-lobes: --range: 9:3: expected LO:HI' "$scripts/plot-lobes" --range 9:3 lobes.json
refused 64 '^plot-lobes: --depth: expected a value' "$scripts/plot-lobes" lobes.json --depth
refused 64 '^plot-lobes: --surface=1: unknown|^plot-lobes: --surface: 1: expected no value' "$scripts/plot-lobes" lobes.json --surface=1
refused 64 '^plot-lobes: -: expected standard input once' "$scripts/plot-lobes" - - </dev/null
refused 65 '^plot-lobes: frf.json: /format: stablecut/frf/1: expected stablecut/lobes/1' "$scripts/plot-lobes" frf.json -o x.svg
"$scripts/plot-frf" frf.json --fitted frf.json --parts complex -o both.svg
check "measured and fitted, real and imaginary" grep -q 'Im H' both.svg
rcsa-couple --quiet --identify "$data/carbide-tap.json" "$data/carbide-in-collet.json" --fitted fitted.json --rigid rigid.json -o joint.json
"$scripts/plot-frf" "$data/carbide-tap.json" --fitted fitted.json --rigid rigid.json -o joint.svg
check "the joint's effect" grep -q 'rigid joint' joint.svg
check "a curve that nothing is known of by its file" grep -q '>carbide-tap<' joint.svg
"$scripts/plot-frf" frf.json -o frf.svg
check "what was synthesized is not called measured" grep -q '>synthesized<' frf.svg
fit-modes --convert --quiet "$data/taps/four-signed.uff" | "$scripts/plot-frf" -o converted.svg
check "what was converted is" grep -q '>measured<' converted.svg
# Several, by label and file name, in one picture; chosen entries; coherence and noise.
jq '.label = "Fräser A_2" | (.frequency_hz | length) as $n | .h[0] += {averages: 8, coherence: [range($n) | 1 - . / 1000], variance: [range($n) | 1e-16]}' frf.json >labelled.json
"$scripts/plot-frf" labelled.json "$data/carbide-tap.json" frf.json --entries xx,xy -o three.svg 2>.err
check "three responses by their names" test "$(grep -oE '>(Fräser A_2|carbide-tap|frf)<' three.svg | sort -u | wc -l)" -eq 3 -a ! -s .err
check "the entries that were asked for" test "$(grep -oE '>H [a-z]+<' three.svg | sort | xargs)" = '>H xx< >H xy<'
check "coherence and noise" test "$(grep -oE '>(coherence|noise, one deviation)<' three.svg | sort -u | wc -l)" -eq 2
"$scripts/plot-frf" frf.json "$data/carbide-tap.json" --linear -o wide.svg
check "the whole of the wider band" grep -q '> *2000<' wide.svg
refused 64 '^plot-frf: --entries: xz: expected one or more of xx, xy, yx, yy' "$scripts/plot-frf" --entries xx,xz frf.json
refused 64 '^plot-frf: --parts: phase: expected magnitude or complex' "$scripts/plot-frf" --parts phase frf.json
"$scripts/plot-frf" --linear --range 100: frf.json -o linear.svg
check "linear axes" test "$(grep -c '> *10<' linear.svg)" -eq 0 -a "$(grep -c '> *900<' linear.svg)" -ge 1
jq '.h[0].response = "slope_x"' frf.json | "$scripts/plot-frf" --entries slope_xx -o slope.svg
check "a slope is in radians" grep -q '>|H|, rad/N<' slope.svg
check "no panel for what does not move" test "$(grep -c 'H x' joint.svg)" -eq 1
"$scripts/plot-frf" --terminal "$data/carbide-tap.json" --fitted fitted.json --rigid rigid.json >text
check "all three in a terminal" grep -q 'rigid joint' text
# Another quantity, a sign, a place: the same curves.
jq '.quantity = "accelerance" | .h[0].response = "-x" | .h[0].response_position_mm = 0' "$data/carbide-tap.json" >tap.json
"$scripts/plot-frf" tap.json --fitted fitted.json -o tap.svg 2>.err
check "fitted over another quantity" test -s tap.svg -a ! -s .err
# The same, converted by hand: a derivative each by i w, the sign of -x.
jq '.quantity = "accelerance" | .frequency_hz as $f | .h[0].response = "-x" | .h[] |= ((if .response == "-x" then -1 else 1 end) as $s
  | .re = [range($f | length) as $i | .re[$i] * -1 * $s * pow(6.283185307179586 * $f[$i]; 2)]
  | .im = [range($f | length) as $i | .im[$i] * -1 * $s * pow(6.283185307179586 * $f[$i]; 2)])' fitted.json >by-hand.json
"$scripts/plot-frf" tap.json --fitted by-hand.json -o by-hand.svg
check "as when converted by hand" cmp -s tap.svg by-hand.svg
"$scripts/plot-frf" tap.json --fitted "$data/carbide-tap.json" -o other.svg
check "and not as another curve" test "$(cmp tap.svg other.svg | wc -l)" -eq 1
jq '.h |= .[3:]' fitted.json >y.json
jq '.h |= .[:1]' "$data/carbide-tap.json" | "$scripts/plot-frf" --rigid y.json -o x.svg 2>.err
check "nothing to draw is said" grep -q 'y.json: nothing to draw over H xx' .err
"$scripts/plot-frf" --label 'with a "joint"' frf.json -o named.svg
check "its name by the user, without harm" grep -q 'with a ?joint?' named.svg
sdm-lobes "$data/thesis-table-6-2.json" --cut "$data/thesis-cut.json" --speed 9000:9000:1 --depth 0.1:0.1:1 --limit-only |
  "$scripts/plot-lobes" -o stable.svg
check "a chart without a limit says so" grep -q 'stable over the whole chart' stable.svg
sdm-lobes "$data/thesis-table-6-2.json" --cut "$data/thesis-cut.json" --speed 5000:20000:12 --modes 3,5,13 --per-mode --limit-only --quiet -o per-mode.json
"$scripts/plot-lobes" --per-mode per-mode.json -o per-mode.svg
check "a curve for each mode with a limit" test "$(grep -oE 'mode [0-9]+ alone' per-mode.svg | sort -u | tr '\n' ' ')" = 'mode 3 alone mode 5 alone '
sdm-lobes "$data/thesis-table-6-2.json" --cut "$data/thesis-cut.json" --speed 9000:12000:6 --depth 0:1.5:2 --per-mode --quiet -o shallow.json
check_jq "some speeds have no limit" shallow.json '[.limit[] | .mode == null] | any and (all | not)'
check "they have no mode" "$scripts/plot-lobes" --per-mode shallow.json -o shallow.svg
refused 65 '^plot-lobes: lobes.json: /per_mode: expected a chart' "$scripts/plot-lobes" --per-mode lobes.json -o x.svg
cp per-mode.json "a'; system \"touch pwned\" #.json"
"$scripts/plot-lobes" lobes.json per-mode.json "a'; system \"touch pwned\" #.json" -o several.svg
check "several limits by their names" test "$(grep -oE '>(lobes|per-mode|a\?\? system \?touch pwned\? \?)<' several.svg | sort -u | wc -l)" -eq 3 -a ! -e pwned
mkdir -p a b && cp lobes.json a/lobes.json && cp per-mode.json b/lobes.json
"$scripts/plot-lobes" a/lobes.json b/lobes.json -o same.svg
check "two of one name by their folders" test "$(grep -cE '<text>[ab]/lobes<' same.svg)" -eq 2
refused 64 '^plot-lobes: --per-mode: expected one input' "$scripts/plot-lobes" --per-mode lobes.json per-mode.json -o x.svg

# The limit's lobes, modes and frequencies; numbers of what to run and of the lowest limit, which may lie between the speeds.
for words in 'chatter, Hz' 'mode [0-9]*' 'lobe [0-9]*' '[0-9.]* mm at [0-9]* rpm'; do check "lobes: $words" grep -q ">$words<" lobes.svg; done
"$scripts/plot-lobes" --plain --range 9000:11000 --depth :2 lobes.json -o plain.svg
check "without frequencies, a part" test "$(grep -c 'chatter, Hz\|>lobe\|> *14000<' plain.svg)" -eq 0 -a "$(grep -c '> *10000<' plain.svg)" -ge 1
jq '.label = "Fräser 12 mm"' lobes.json | "$scripts/plot-lobes" -o label.svg && grep -q '>Fräser 12 mm: Stability lobes' label.svg
check "a chart's label" test $? -eq 0
sdm-lobes "$data/thesis-table-6-2.json" --cut "$data/thesis-cut.json" --speed 9000:12000:6 --depth 0:2:5 --samples 5 --quiet 2>/dev/null | "$scripts/plot-lobes" --probability -o probability.svg
check "shading by probability, and the interval" test "$(grep -oE '>(probability of stability|95 % interval)<' probability.svg | sort -u | wc -l)" -eq 2
refused 65 '^plot-lobes: lobes.json: /probability_stable: expected a chart of sdm-lobes --samples' "$scripts/plot-lobes" --probability lobes.json -o x.svg
# A limit between two speeds that are stable to the top.
jq 'del(.what_to_run, .points, .crossings) | .limit |= [.[0] | {speed_rpm: 5000, depth_mm: null}, . + {speed_rpm: 10000, depth_mm: 1.5}, {speed_rpm: 20000, depth_mm: null}]' \
  lobes.json >between.json
"$scripts/plot-lobes" between.json -o between.svg
check "it is drawn" test "$(grep -c '<text>limit<' between.svg)" -eq 1 -a "$(grep -c 'stable over the whole' between.svg)" -eq 0
jq '.limit[] |= del(.mode, .lobe)' lobes.json >no-modes.json
"$scripts/plot-lobes" no-modes.json -o no-modes.svg
check "a chart that does not say its modes" grep -q '>mode unknown<' no-modes.svg
jq 'del(.spectral_radius)' lobes.json | "$scripts/plot-lobes" -o no-grid.svg
check "without a grid no scale of its colours" test "$(grep -c 'spectral radius of a tooth' no-grid.svg)" -eq 0 -a "$(grep -c 'axial depth' no-grid.svg)" -ge 1
# Numbers of modes in a part of the band, and those of the table.
"$scripts/plot-stabilization" stabilization.json --range 40:80 -o zoom.svg
check "modes with frequency and damping" grep -qE '>4: 4[34]\.[0-9]* Hz, [0-9.]+ %<' zoom.svg
jq '.modes |= [.[0] | .out_of_band = true] + .' modes.json >shifted.json
"$scripts/plot-stabilization" stabilization.json --range 40:80 --modes shifted.json -o zoom.svg
check "with the numbers of the table" grep -qE '>5: 4[34]\.[0-9]* Hz, [0-9.]+ %<' zoom.svg

"$scripts/plot-pose-map" pose-map.json --pose pose.json -o marked.svg
check "best pose and unit" grep -q 'best pose' marked.svg
best-pose --robot "$robot" --height 1600 --x=-2600:2600:14 --y=-2600:2600:14 --redundancy 30:30:1 --map turned.json k2d.json -o pose.json
"$scripts/plot-pose-map" --directional pose-map.json turned.json -o directional.svg
check "directional maps name axis and angle" grep -q 'redundancy angle 30 deg' directional.svg
check "the plane that all have stands in the title" grep -q 'Best pose at each point, z = 1600 mm<' directional.svg
"$scripts/plot-pose-map" pose-map.json turned.json --show score,redundancy,branch -o shown.svg
check "redundancy and branch of two maps, by their names" test "$(grep -oE '>(pose-map|turned): (weakest|redundancy angle|branch)[^<]*<' shown.svg | wc -l)" -eq 6
check "what a branch is" grep -q '>[0-7]: front, elbow [+-], wrist not flipped<' shown.svg
refused 64 '^plot-pose-map: --show: scroe: expected one or more of score' "$scripts/plot-pose-map" --show scroe pose-map.json
refused 64 '^plot-pose-map: --directional: expected without --show' "$scripts/plot-pose-map" --show branch --directional pose-map.json
# Strings of a document never reach gnuplot as commands.
jq '.index.name = "a\u0027; system \"touch pwned\" #"' pose-map.json >evil.json
refused 65 '^plot-pose-map: evil.json: /index/name: expected one of' "$scripts/plot-pose-map" evil.json -o x.svg
jq '.cut.milling = "a\" ; system \"touch pwned\" #`touch pwned`" | .method = "spectral"' lobes.json >evil.json
refused 65 '^plot-lobes: evil.json: /cut/milling: expected one of' "$scripts/plot-lobes" evil.json -o x.svg
jq '.h[0].response = "x\u0027; system \"touch pwned\" #`touch pwned`"' frf.json >evil.json
"$scripts/plot-frf" evil.json -o evil.svg 2>.err || check "a name is drawn or refused" grep -q 'evil.json: /h/0/response' .err
check "no command runs" test ! -e pwned
jq '.score = .score[1:]' pose-map.json >short.json
refused 65 '^plot-pose-map: short.json: /score: 13 values: expected 14' "$scripts/plot-pose-map" short.json -o x.svg
jq '.x_mm[3] = .x_mm[2]' pose-map.json >same.json
refused 65 '^plot-pose-map: same.json: /x_mm/3: .*: expected more than' "$scripts/plot-pose-map" same.json -o x.svg
jq '.speed_rpm = [] | .spectral_radius |= map([])' lobes.json >none.json
refused 65 '^plot-lobes: none.json: /speed_rpm: expected at least 1 item' "$scripts/plot-lobes" none.json -o x.svg
refused 73 '^plot-pose-map: none/x.svg: cannot be created' "$scripts/plot-pose-map" pose-map.json -o none/x.svg
best-pose --robot "$robot" --plane-origin 1800,0,1500 --plane-x 0,1,0 --plane-y 0,0,1 --tool-axis 1,0,0 --x=-900:900:9 --y=-900:900:9 \
  --map wall.json k2d.json -o wall-pose.json
check "a wall, its best pose in its own coordinates" "$scripts/plot-pose-map" wall.json --pose wall-pose.json -o wall.png
refused 65 '^plot-pose-map: wall-pose.json: /height_mm: expected a search in the plane of the map' "$scripts/plot-pose-map" pose-map.json --pose wall-pose.json -o x.svg
refused 65 '^plot-pose-map: pose.json: /format: stablecut/pose/1: expected stablecut/pose-map/1' "$scripts/plot-pose-map" pose.json -o x.svg
best-pose --robot "$robot" --height 1600 --x 0:100:2 --y 1500:1500:1 --index deflection --force 0,0,-9 --quiet --map line.json k2d.json -o pose.json
check "a map of a line" "$scripts/plot-pose-map" line.json -o line.svg

# Paths.
check "the worst point's reason" grep -q 'worst point [0-9]*: ' path.svg
"$scripts/plot-path" path.json --map pose-map.json -o over.svg
check "a path over its map" grep -q 'over the best poses at z = 1600 mm' over.svg
jq '.std_n_m_per_rad = [1e6, 1e6, 1e6, 1e5, 1e5, 1e5]' k2d.json >uncertain.json
jq '.points[12].position_mm[0] = 3000' tool-path.json >broken.json
best-pose --robot "$robot" --path broken.json --partial --force 0,0,-100 --quiet uncertain.json -o partial.json
check_jq "a path in parts" partial.json '(.parts | length) > 1'
"$scripts/plot-path" partial.json -o partial.svg 2>.err
check "is drawn, with its deviations" test -s partial.svg -a ! -s .err
best-pose --robot "$robot" --path tool-path.json --place=-100:100:3,-100:100:3,0:45:2 --force 0,0,-100 --quiet k2d.json -o place.json
"$scripts/plot-path" place.json -o place.svg 2>.err
check "places, and which is the best" grep -q 'best: -*[0-9]*, -*[0-9]*, 0 mm, [0-9]* deg' place.svg
check "without a word" test ! -s .err
jq '.placement.map |= map(.outcome = "no-pose" | .objective = null | .bound = null)' place.json >nowhere.json
check "places that are not driven" "$scripts/plot-path" nowhere.json -o nowhere.svg
jq '.points[3] |= del(.tcp_mm)' path.json >short.json
refused 65 '^plot-path: short.json: /points/3/tcp_mm: missing' "$scripts/plot-path" short.json -o x.svg
# A text where a number belongs would be a command, of gnuplot (system) or of the shell's arithmetic.
for plot in lobes frf pose-map stabilization path; do
  places=0
  while read -r place; do
    jq --argjson place "$place" 'setpath($place; "a[system(1)]")' $plot.json >hostile.json
    "$scripts/plot-$plot" hostile.json -o hostile.svg 2>.err
    test $? -eq 65 -a ! -e hostile.svg && grep -q "^plot-$plot: hostile.json: /.*: expected" .err && places=$((places + 1)) ||
      check "plot-$plot: a text at $place" false
  done < <(jq -c 'del(.provenance, .cut, .what_to_run) | [paths(type == "number")] | map(select(all(.[]; . == 0 or type == "string"))) | .[]' $plot.json)
  check "plot-$plot: no text in the place of a number" test $places -ge 2
done
refused 65 '^plot-path: wall.json: /height_mm: expected a horizontal plane' "$scripts/plot-path" path.json --map wall.json -o x.svg

# Forces.
check "growth and samples" grep -q 'growth per tooth' force.svg
"$scripts/plot-force" --point 21 force.json -o point.svg
check "another point" grep -q '2 mm, 5000 rpm: growth 1.36' point.svg
refused 64 '^plot-force: --point: 22: expected a number from 1 to 21' "$scripts/plot-force" --point 22 force.json -o x.svg
refused 64 '^plot-force: --point: a\[0\]: expected' "$scripts/plot-force" --point 'a[0]' force.json -o x.svg
cut-force fed.json --harmonics 0 -o alone.json
"$scripts/plot-force" alone.json -o alone.svg 2>.err
check "a force without points and harmonics, without a word" test -s alone.svg -a ! -s .err
for field in .depth_mm '.mean_force_n[1]' '.wave.axial_n[3]' '.harmonics[0].force_n[0][0]' '.points[2].speed_rpm' '.points[2].samples_um.feed[0]'; do
  jq "$field = \"system(1)\"" force.json >hostile.json
  refused 65 '^plot-force: hostile.json: .*expected number' "$scripts/plot-force" hostile.json -o x.svg
done

# What pictures are made of.
check "parts of pictures" env PYTHONPATH="$scripts" PYTHONDONTWRITEBYTECODE=1 /usr/bin/python3 "$SOURCE/apps/pipeline/plotting_test.py"
