#!/usr/bin/env bash
# A label goes from every kind of document that a tool reads to every document that the tool writes, and to pictures.
. "$SOURCE/apps/testing.sh"
scripts=$SOURCE/scripts

# label TEXT FILE: the document with that label.
label() { jq --arg text "$1" '.label = $text' "$2"; }
# labelled NAME LABEL FILE...: each file is a document that has this label.
labelled() {
  local name=$1 expected=$2 file; shift 2
  for file; do check_jq "$name: $file" "$file" '.label == $text' --arg text "$expected"; done
}

label "pose 3" "$data/thesis-table-6-2.json" >table.json
label slot "$data/thesis-cut.json" | jq '.feed_per_tooth_mm = 0.1' >cut.json
chart=(--speed 9000:12000:2 --depth 0:1:2)
fit-modes --synthesize 2:300:600 table.json -o tap.json
fit-modes --quiet --band 2:60 tap.json --fitted fitted.json --stabilization diagram.json -o modes.json
fit-modes --convert tap.json -o converted.json
labelled fit-modes "pose 3" tap.json fitted.json diagram.json modes.json converted.json
label "last year" modes.json >old.json
jq 'del(.label)' modes.json >nameless.json
fit-modes --track old.json modes.json -o tracked.json
fit-modes --track old.json nameless.json -o nameless-tracked.json
labelled "a table that follows another" "pose 3" tracked.json
check_jq "an old label is not a new table's" nameless-tracked.json 'has("label") | not'

sdm-lobes table.json --cut cut.json "${chart[@]}" -o lobes.json
cut-force --quiet cut.json --table table.json --depth 0.5 --speed 9000 -o force.json
labelled "table and cut" "slot, pose 3" lobes.json force.json
check_jq "the cut inside has none" lobes.json '.cut | has("label") | not'
sdm-lobes table.json --cut cut.json "${chart[@]}" --shard 1/2 -o part1.json
sdm-lobes table.json --cut cut.json "${chart[@]}" --shard 2/2 -o part2.json
sdm-lobes table.json --cut cut.json "${chart[@]}" --merge part1.json --merge part2.json -o whole.json
check "parts and the whole say the same" cmp lobes.json whole.json
label "end mill" "$data/slotting-tool.json" | cut-force --identify "$data/slot-forces.csv" - -o found.json
labelled "identified coefficients" "end mill" found.json
sdm-lobes table.json --cut cut.json "${chart[@]}" --label "one, two" -o named.json
labelled "--label" "one, two" named.json
check_jq "--label is in the provenance" named.json '.provenance.arguments | index("--label") as $i | .[$i + 1] == "one, two"'
sdm-lobes table.json --cut cut.json "${chart[@]}" --csv document >values.csv && grep -q '^label,"slot, pose 3"' values.csv
check "the table of single values has it" test $? -eq 0

label "cell 2" "$data/kr360.json" >robot.json
joint-stiffness --quiet --robot robot.json "$data/kr360-loads.csv" -o stiffness.json
labelled "robot" "cell 2" stiffness.json
label "cell 2, loads of May" stiffness.json >may.json
best-pose --quiet --robot robot.json --height 1600 --x 1500:1700:2 --y 0:0:1 --map map.json may.json -o pose.json
labelled "robot and stiffness, each part once" "cell 2, loads of May" pose.json map.json
jq 'del(.label)' stiffness.json >plain.json
label zigzag "$data/zigzag-path.json" | jq '.points |= .[:5]' |
  best-pose --quiet --robot "$data/kr360.json" --path - --force 200,400,-150 plain.json -o motion.json
labelled "a path" zigzag motion.json
jq '{format: "stablecut/pose-list/1", label: "papers", poses: [.height_1600_mm[] | {joints_deg}]}' "$data/yanshan-poses.json" >poses.json
best-pose --quiet --robot "$data/kr360.json" --evaluate poses.json plain.json -o evaluated.json
joint-stiffness --quiet --robot "$data/kr360.json" --plan 6 poses.json -o plan.json
labelled "a list of poses" papers evaluated.json plan.json

label "stub b" "$data/liu-assembly.json" | rcsa-couple - -o tip.json
labelled "an assembly" "stub b" tip.json
rcsa-couple --quiet --label "in the collet" --identify "$data/carbide-tap.json" "$data/carbide-in-collet.json" -o joint.json
jq '.holder.end.receptances.file |= $data + "/" + .' --arg data "$data" "$data/carbide-in-collet.json" |
  rcsa-couple --quiet --joint joint.json - -o with-joint.json
labelled "a joint" "in the collet" with-joint.json

for kind in table cut robot; do jq '.label = 3' $kind.json >wrong-$kind.json; done
refused 65 '^fit-modes: wrong-table.json: /label: 3: expected a text$' fit-modes --synthesize 2:10:3 wrong-table.json
refused 65 '^sdm-lobes: wrong-cut.json: /label: 3: expected a text$' sdm-lobes --cut wrong-cut.json table.json
refused 65 '^joint-stiffness: wrong-robot.json: /label: 3: expected a text$' joint-stiffness --robot wrong-robot.json "$data/kr360-loads.csv"
refused 64 '^sdm-lobes: --label: empty: expected' sdm-lobes --label "" --cut cut.json table.json

# Pictures: the name of a chart, and where two have the same, their files.
"$scripts/plot-lobes" lobes.json >picture.svg 2>/dev/null && grep -q '>slot, pose 3: Stability lobes' picture.svg
check "the title of a chart" test $? -eq 0
"$scripts/plot-lobes" lobes.json named.json >two.svg && grep -q '>slot, pose 3<' two.svg && grep -q '>one, two<' two.svg
check "two labels" test $? -eq 0
"$scripts/plot-lobes" lobes.json whole.json >same.svg && grep -q '>lobes<' same.svg && grep -q '>whole<' same.svg
check "files where the labels are the same" test $? -eq 0
for picture in "plot-frf tap.json --fitted fitted.json" "plot-stabilization diagram.json" "plot-force force.json" "plot-pose-map map.json" "plot-path motion.json"; do
  read -ra command <<<"$picture"
  name=$(jq -r .label "${command[1]}")
  "$scripts/${command[0]}" "${command[@]:1}" >picture.svg && grep -q "[>:] *$name" picture.svg
  check "the label in the picture: $picture" test $? -eq 0
done
"$scripts/plot-frf" tap.json --fitted fitted.json >picture.svg && grep -q '>fitted<' picture.svg
check "a fit is called so, whatever its label" test $? -eq 0
"$scripts/report" lobes.json modes.json -o page.html && grep -q 'Stability: slot, pose 3' page.html && grep -q 'Modes: pose 3' page.html
check "the label in the report" test $? -eq 0
