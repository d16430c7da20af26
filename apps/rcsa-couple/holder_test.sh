#!/usr/bin/env bash
# rcsa-couple: holders by modal tables and by taps, measured spindles under beams, their limits, bad input.
. "$SOURCE/apps/testing.sh"
cp "$data"/spindle-*.json "$data/carbide-in-collet.json" .
rcsa-couple carbide-in-collet.json -o taps.json 2>log
jq '.holder.end = {modal_table: {file: "spindle-modes.json"}}' carbide-in-collet.json >of-modes.json
rcsa-couple of-modes.json -o modes.json
close='def close(share): [.[0].re, .[0].im, .[1].re, .[1].im] | transpose | (map(pow(.[0] - .[2]; 2) + pow(.[1] - .[3]; 2)) | add) <= share * share * (map(pow(.[2]; 2) + pow(.[3]; 2)) | add);'
check_jq "taps along an artefact are near the modes they came from" taps.json "$close ([.h[0], \$modes[0].h[0]] | close(0.05)) and ([.h[3], \$modes[0].h[3]] | close(0.05))" --slurpfile modes modes.json
check_jq "what is known of the spindle" taps.json '.holder.x.slopes == "artefact" and .holder.y.below_noise.lines == 0 and .holder.x.not_passive.lines < 20'
check_jq "x and y differ, and do not couple" taps.json '.h[0].re != .h[3].re and (.h[1].re | all(. == 0))'
check_jq "provenance names the taps" taps.json '[.provenance.inputs[].name | split("/")[-1]] == ["carbide-in-collet.json", "spindle-taps.json"]'

# The same document inline, in another folder, and through standard input.
jq --slurpfile taps spindle-taps.json '.holder.end.receptances = $taps[0]' carbide-in-collet.json >inline.json
rcsa-couple --no-provenance --quiet inline.json -o inline-out.json
mkdir folder && cp carbide-in-collet.json spindle-taps.json folder
rcsa-couple --no-provenance --quiet folder/carbide-in-collet.json -o folder-out.json
rcsa-couple --no-provenance --quiet <carbide-in-collet.json >stdin-out.json
check "inline and by file" cmp -s inline-out.json folder-out.json
check "relative to the assembly, or to here for standard input" cmp -s stdin-out.json folder-out.json

# A spindle that couples x and y: all four entries at the tip.
jq '.modes[] |= (.psi_r[2] = (.psi_r[0] | map(. * 0.3 + 1e-4)) | .psi_r[3] = [0.01, 0] | .psi_l = .psi_r)' spindle-modes.json >coupled.json
jq '.holder = {modal_table: {file: "coupled.json"}}' carbide-in-collet.json | rcsa-couple -o both.json
check_jq "cross terms" both.json '(.h[1].re | any(. != 0)) and ([.h[1].re, .h[2].re] | transpose | all((.[0] - .[1] | fabs) <= 1e-9 * (.[0] | fabs) + 1e-20))'
jq '.holder = {x: {modal_table: {file: "coupled.json"}}, y: {modal_table: {file: "coupled.json"}}}' carbide-in-collet.json | rcsa-couple -o apart.json
check_jq "each direction by itself" apart.json '.h[1].re | all(. == 0)'

# Two places on a face: the finite difference, said with its limits; columns of a file with places.
jq -r '.frequency_hz as $f | .h[0] as $h | range($f | length) | "\($f[.]) \($h.re[.]) \($h.im[.])"' spindle-taps.json >here.txt
jq -r '.frequency_hz as $f | .h[2] as $h | range($f | length) | "\($f[.]) \($h.re[.]) \($h.im[.])"' spindle-taps.json >there.txt
jq '.holder = {receptances: [{file: "here.txt"}, {file: "there.txt", reference_position_mm: 45}]}' carbide-in-collet.json >difference.json
rcsa-couple difference.json -o difference-out.json 2>log
check_jq "the finite difference" difference-out.json '.holder.x == .holder.y and .holder.x.slopes == "finite difference" and .holder.x.spacing_mm == 45 and .holder.x.moment_to_slope == "l n / h"'
check "its limits are said" grep -q 'finite difference over 45 mm, good where the part bends little between' log
check "one direction serves both, and says so" grep -q 'yy is missing: y is taken as x' log
# Measured lines with a gap across a resonance (310 Hz): said, with the gap, by the warning and the document; the same lines evenly, not.
clean='.h |= map(del(.variance))'
jq "$clean"' | [range(.frequency_hz | length)] as $all | .frequency_hz as $f | ($all | map(select($f[.] <= 280 or $f[.] >= 340))) as $kept
  | .frequency_hz |= [.[$kept[]]] | .h |= map(.re |= [.[$kept[]]] | .im |= [.[$kept[]]])' spindle-taps.json >gap.json
jq '.frequency_hz.from = 100 | .holder.end.receptances.file = "gap.json"' carbide-in-collet.json | rcsa-couple -o gap-out.json 2>log
check "a gap across a resonance is said" grep -q 'x: .*nothing was measured between 280 and 340 Hz: the lines there are interpolated and may be off by' log
check_jq "and in the document" gap-out.json '.holder.x.interpolated | length >= 1 and (.[0].band_hz == [280, 340] and .[0].error > 0.1)'
jq '.frequency_hz = {from: 100, to: 3900, count: 7601}' carbide-in-collet.json | rcsa-couple -o even-out.json 2>log
check "lines at equal distances, interpolated: nothing is said of gaps" sh -c '! grep -q "nothing was measured" log'
check_jq "nor in the document" even-out.json '.holder.x | has("interpolated") | not'

# A sensor's mass: taps loaded by it on the artefact, and without it.
jq '{format, frequency_hz: {from: 50, to: 4000, count: 396}, beam_theory, materials, tool: .holder.end.artefact, holder: {modal_table: {file: "spindle-modes.json"}}, joint: "rigid"}' carbide-in-collet.json >artefact.json
rcsa-couple artefact.json --positions 0,45 -o light.json
jq '.sensor_mass_g = 8' artefact.json | rcsa-couple -o loaded-tip.json
jq --slurpfile tip loaded-tip.json '.frequency_hz as $f | .h |= map(select(.response == .reference)) | .h |= map(. as $e
  | ([$tip[0].h[] | select(.response == $e.response and .reference == $e.response)][0]) as $w
  | select(.response_position_mm == 0) | if .reference_position_mm == 0 then .re = $w.re | .im = $w.im else
    ([$f, .re, .im, $w.re, $w.im] | transpose | map(. as [$hz, $a, $b, $c, $d] | (0.008 * pow(6.283185307179586 * $hz; 2)) as $m
      | [$a + $m * ($a * $c - $b * $d), $b + $m * ($a * $d + $b * $c)])) as $new | .re = ($new | map(.[0])) | .im = ($new | map(.[1])) end)' light.json >loaded.json
jq '.h |= map(select(.response == .reference and .response_position_mm == 0))' light.json >free.json
for taps in loaded free; do
  jq --arg f $taps.json --argjson m "$([ $taps = loaded ] && echo 8 || echo 0)" '.frequency_hz.count = 396 | .holder = {receptances: {file: $f}, sensor_mass_g: $m}' carbide-in-collet.json | rcsa-couple --quiet -o $taps-out.json
done
check_jq "a sensor's mass taken away" loaded-out.json "$close [.h[0], \$free[0].h[0]] | close(1e-6)" --slurpfile free free-out.json

with() {
  jq "$2" "$1" >bad.json
  refused "$3" "^rcsa-couple: $4" rcsa-couple bad.json -o result.json
}
taps=carbide-in-collet.json
with $taps '.holder.end = {}' 65 'bad.json: /holder/end/receptances: missing'
with $taps '.holder.end.modal_table = {}' 65 'bad.json: /holder/end/receptances: .*not both'
with $taps '.holder.modal_table = {file: "spindle-modes.json"}' 65 'bad.json: /holder/segments: .*expected either segments and an end'
with $taps '.holder.sensor_mass_g = 2' 65 'bad.json: /holder/sensor_mass_g: 2: expected only beside receptances'
with of-modes.json '.holder.end.artefact = {}' 65 'bad.json: /holder/end/artefact: .*expected only beside receptances'
with difference.json '.holder.receptances[1].reference_position_mm = 0' 65 'bad.json: /holder/receptances/1: .*xx at these places is in the list already'
with $taps '.holder.end.artefact.segments[0].length_mm = 40' 65 'bad.json: /holder/end/receptances: position 45 mm: expected a place on the artefact, up to 40'
with $taps '.holder.end.receptances.file = "none.json"' 66 'none.json: cannot be read'
with $taps '.holder.end.receptances.file = "spindle-modes.json"' 65 'spindle-modes.json: /format: .*expected "stablecut/frf/1"'
with $taps '.frequency_hz.to = 5000' 65 'bad.json: /holder/end/receptances: line at 4.* Hz: expected the measured band, 50'
with $taps 'del(.holder.end.artefact) | .holder.end.receptances = {file: "here.txt"}' 65 'bad.json: /holder/end/receptances: xx: no slopes and no second place'
with of-modes.json '.holder.end.modal_table.file = "two.json"' 66 'two.json: cannot be read'
jq '.dofs = ["x", "y", "slope_y", "z"]' spindle-modes.json >two.json
with of-modes.json '.holder.end.modal_table.file = "two.json"' 65 'two.json: /dofs: expected x and slope_x together'
with inline.json '.holder.end.receptances.h[0].re = [1]' 65 'bad.json: /holder/end/receptances/h/0/re: a list of 1: expected 396 numbers'
with $taps '.holder.end.artefact.segments[0].material = "wood"' 65 'bad.json: /holder/end/artefact/segments/0/material: "wood": expected one of'
with difference.json '.holder.receptances[1].reference_position_mm = -1' 65 'bad.json: /holder/receptances/1/reference_position_mm: -1: expected'
printf 'f,Re (V/V),Im (V/V)\n100,1,2\n' >volts.csv
with difference.json '.holder.receptances[0].file = "volts.csv"' 65 'volts.csv: line 1: V/V: .*, as m/N \("unit" beside its "file"\)$'
check "nothing was written" test ! -e result.json

# Measured points that this project did not write.
if [ -d "$SOURCE/../shared/real/ubc-tool" ]; then
  ubc=$(cd "$SOURCE/../shared/real/ubc-tool" && pwd)
  jq --arg p "$ubc" '.frequency_hz = {from: 100, to: 4500, count: 4401} | .holder = {receptances: [{file: ($p + "/point1.txt")},
    {file: ($p + "/point2.txt"), reference_position_mm: 55}]}' carbide-in-collet.json | rcsa-couple -o ubc.json 2>log
  check_jq "two measured points: runs, with its limits" ubc.json '.holder.x.spacing_mm == 55 and .holder.x.not_passive.lines > 100 and (.h[0].re | length) == 4401'
  check "and says them" grep -q 'not passive' log
else
  echo "skipped: no measured points here"
fi
