#!/usr/bin/env bash
# rcsa-couple: the published example, exact limits, directions, bad input.
. "$SOURCE/apps/testing.sh"
assembly=$data/liu-assembly.json
same_for_every_tool rcsa-couple frf

rcsa-couple "$assembly" -o joint.json
jq '.joint = "rigid"' "$assembly" | rcsa-couple -o rigid.json
jq '.joint = "rigid" | .tool.segments[0].length_mm = 100 | .holder.segments = [.holder.segments[0] | .length_mm = 18.92, .length_mm = 50.9]' "$assembly" |
  rcsa-couple -o parts.json
size='def size: [.h[0].re, .h[0].im] | transpose | map(map(. * .) | add | sqrt); def peak(lo; hi): .frequency_hz as $f | size as $s
  | [range($f | length) | select($f[.] >= lo and $f[.] <= hi)] | max_by($s[.]) | $f[.];'
check_jq "four entries, zeros across" joint.json '[.h[] | .response + .reference] == ["xx", "xy", "yx", "yy"] and (.h[1].re | all(. == 0)) and .h[0].re == .h[3].re'
check_jq "peaks with the joint" joint.json "$size peak(200; 500) == 294 and (peak(1500; 2500) - 1830 | fabs) <= 1"
check_jq "peaks without it" rigid.json "$size peak(200; 500) == 295 and (peak(1500; 2500) - 1848 | fabs) <= 1"
check_jq "the paper's objective" joint.json "$size [size, (\$rigid[0] | size)] | transpose | map(.[0] - .[1] | . * .) | add | sqrt | (. / 6.82e-5 - 1 | fabs) < 1e-3" --slurpfile rigid rigid.json
check_jq "however it is cut in parts" parts.json "$size [.h[0].re, (\$rigid[0] | .h[0].re, size)] | transpose | all((.[0] - .[1] | fabs) <= 1e-9 * .[2])" --slurpfile rigid rigid.json
rcsa-couple "$assembly" --slopes -o slopes.json
check_jq "slopes, reciprocal" slopes.json '(.h | length) == 16 and ([.h[] | select(.response == "x" and .reference == "slope_x")][0].re as $a
  | [.h[] | select(.response == "slope_x" and .reference == "x")][0].re as $b | [$a, $b] | transpose | all((.[0] - .[1] | fabs) <= 1e-9 * (.[0] | fabs)))'
jq '.joint = {x: "rigid", y: .joint} | .holder = {x: .holder, y: (.holder | .end = "free")}' "$assembly" | rcsa-couple -o apart.json
check_jq "x and y apart" apart.json '.h[0].re == $rigid[0].h[0].re and .h[3].re != $rigid[0].h[3].re' --slurpfile rigid rigid.json

# Held farther out, by the segment at the joint; files of the assembly are found beside it.
jq '.tool.segments = [.tool.segments[0] | .length_mm = 20, .length_mm = 110]' "$assembly" | rcsa-couple --no-provenance -o longer.json
jq '.tool.segments = [.tool.segments[0] | .length_mm = 20, .length_mm = 90]' "$assembly" >two.json
rcsa-couple --no-provenance --overhang 130 two.json -o overhang.json
check "another overhang" cmp -s longer.json overhang.json
check "of a measured holder" rcsa-couple --quiet --overhang 68 "$data/carbide-in-collet.json" -o collet.json
refused 64 '^rcsa-couple: --overhang: 20: expected more than 20 mm, the tool without its segment at the joint' rcsa-couple --overhang 20 two.json
refused 64 '^rcsa-couple: --overhang: -1: expected a number above 0' rcsa-couple --overhang -1 two.json

# A wall: the clamped beam as a word, as an end, and as the limit of a stub that is nearly none.
jq '.joint = "rigid" | .holder = "fixed"' "$assembly" | rcsa-couple --no-provenance -o wall.json
jq '.joint = "rigid" | .holder = {end: "fixed"}' "$assembly" | rcsa-couple --no-provenance -o end.json
jq '.joint = "rigid" | .holder = {end: "fixed", segments: []}' "$assembly" | rcsa-couple --no-provenance -o none.json
jq '.joint = "rigid" | .holder.segments[0].length_mm = 1e-9' "$assembly" | rcsa-couple --quiet -o stub.json
check "a holder that is a wall" cmp -s wall.json end.json
check "and without segments" cmp -s wall.json none.json
check_jq "as a stub that is nearly none" stub.json "$size [size, (\$wall[0] | size)] | transpose | all((.[0] / .[1] - 1 | fabs) < 1e-6)" --slurpfile wall wall.json
check_jq "its static stiffness, l^3 / 3 E I" wall.json '.h[0].re[0] / (pow(0.11892; 3) / (3 * 200e9 * 3.141592653589793 / 64 * pow(0.012; 4))) - 1 | fabs < 1e-3'
jq '.holder = {x: "fixed", y: .holder}' "$assembly" | rcsa-couple -o one-wall.json
check_jq "a wall in one direction, springs on it" one-wall.json '.h[0].re != .h[3].re and .h[3].re == $joint[0].h[3].re' --slurpfile joint joint.json

# A segment of 1e-6 mm anywhere in tool and holder changes nothing.
jq '.tool.segments = [.tool.segments[0] | (.length_mm = 1e-6), (.length_mm = 60), (.length_mm = 1e-6), (.length_mm = 58.919997), (.length_mm = 1e-6)]' "$assembly" |
  rcsa-couple -o thin-parts.json
check_jq "segments of 1e-6 mm" thin-parts.json "$size [.h[0].re, .h[0].im, (\$joint[0] | .h[0].re, .h[0].im, size)] | transpose
  | all((.[0] - .[2] | fabs) <= 1e-9 * .[4] and (.[1] - .[3] | fabs) <= 1e-9 * .[4])" --slurpfile joint joint.json

# Numbers in other units than the expected ones are said, with what was likely meant.
said() {
  jq "$1" "$assembly" | rcsa-couple --no-provenance -o doubt.json 2>log
  check "said: $2" grep -q "^rcsa-couple: warning: <stdin>: $2" log
  check "in one line" test "$(wc -l <log)" = 1
}
said '.materials.steel.youngs_modulus_gpa = 200000' '/materials/steel/youngs_modulus_gpa: 200000: no solid is as stiff: were 200 GPa meant?$'
said '.materials.steel.youngs_modulus_gpa = 2e11' '/materials/steel/youngs_modulus_gpa: 2e+11: no solid is as stiff: were 200 GPa meant?$'
said '.materials.steel.youngs_modulus_gpa = 0.2' '/materials/steel/youngs_modulus_gpa: 0.2: with 7800 kg/m3 a wave speed of 160 m/s, .*: were 200 GPa meant?$'
said '.materials.steel.density_kg_per_m3 = 7.8' '/materials/steel/density_kg_per_m3: 7.8: no solid has this density: were 7800 kg/m3 meant?$'
said '.materials.steel.density_kg_per_m3 = 7.8e6' '/materials/steel/density_kg_per_m3: 7.8e+06: no solid has this density: were 7800 kg/m3 meant?$'
said '.materials.steel |= (.youngs_modulus_gpa = 200000 | .density_kg_per_m3 = 7.8e-9)' '/materials/steel/youngs_modulus_gpa: 200000: no solid is as stiff: were 200 GPa and 7800 kg/m3 meant?$'
said '.tool.segments[0] |= (.length_mm = 0.11892 | .outer_diameter_mm = 0.012)' '/tool/segments: at most 0.012 mm thick, as no tool and no holder is: were 12 mm meant?'
said '.tool.segments[0].length_mm = 0.11892' '/tool/segments: together 0.11892 mm long, as no tool and no holder is: were 118.92 mm meant?'
said '.holder.segments[0] |= (.length_mm = 0.0509 | .outer_diameter_mm = 0.012)' '/holder/segments: at most 0.012 mm thick'

# Flutes: 0.8 of the diameter, or what is said.
jq '.tool.segments[0].flutes = 4' "$assembly" | rcsa-couple --no-provenance -o fluted.json
jq '.tool.segments[0] |= (.outer_diameter_mm = 12 | .equivalent_diameter_mm = 9.6)' "$assembly" | rcsa-couple --no-provenance -o equivalent.json
jq '.tool.segments[0].outer_diameter_mm = 9.6' "$assembly" | rcsa-couple --no-provenance -o thin.json
check_jq "flutes by their equivalent diameter" fluted.json '[.h[0].re, $thin[0].h[0].re] | transpose | all((.[0] - .[1] | fabs) <= 1e-9 * (.[1] | fabs) + 1e-18)' --slurpfile thin thin.json
check "an equivalent diameter" cmp -s equivalent.json thin.json
# A sensor's mass: 1/h + w^2 m, and h again when it is taken from there.
jq '.sensor_mass_g = 5' "$assembly" | rcsa-couple -o sensor.json
check_jq "a sensor on the tip: 1/h - 1/h_with = m w^2" sensor.json '[.frequency_hz, .h[0].re, .h[0].im, $bare[0].h[0].re, $bare[0].h[0].im] | transpose
  | map(. as [$f, $a, $b, $c, $d] | ($c / ($c * $c + $d * $d) - $a / ($a * $a + $b * $b)) / (0.005 * pow(6.283185307179586 * $f; 2)) - 1 | fabs)
  | .[100:] | length > 4000 and all(. < 1e-6)' --slurpfile bare joint.json
# Along the tool: the tip, reciprocity.
rcsa-couple "$assembly" --positions 0,40 -o along.json
check_jq "places along the tool" along.json '(.h | length) == 16 and .h[0].response_position_mm == 0 and .h[4].reference_position_mm == 40
  and ([.h[4].re, .h[8].re] | transpose | all((.[0] - .[1] | fabs) <= 1e-9 * (.[0] | fabs)))
  and ([.h[0].re, $tip[0].h[0].re] | transpose | .[10:] | all((.[0] - .[1] | fabs) <= 1e-8 * (.[0] | fabs)))' --slurpfile tip joint.json
refused 64 '^rcsa-couple: --positions: 0,x: expected' rcsa-couple "$assembly" --positions 0,x
refused 64 '^rcsa-couple: --positions: 0,0: expected each place once' rcsa-couple "$assembly" --positions 0,0
refused 65 '^rcsa-couple: position 200.* mm: expected 0 to 118.9' rcsa-couple "$assembly" --positions 0,200
rcsa-couple --threads 1 "$assembly" >one.json
rcsa-couple --threads 2 "$assembly" >two.json
check "same bytes on one and two threads" cmp -s one.json two.json

with() {
  jq "$1" "$assembly" >bad.json
  refused 65 "^rcsa-couple: bad.json: $2" rcsa-couple bad.json -o result.json
}
with '.tool.segments = []' '/tool/segments: a list of 0: expected'
with '.tool.segments[0].material = "wood"' '/tool/segments/0/material: "wood": expected one of /materials'
with '.tool.segments[0].length_mm = 0' '/tool/segments/0/length_mm: 0: expected a size above 0'
with '.tool.segments[0].inner_diameter_mm = 12' '/tool/segments/0/inner_diameter_mm: 12: expected less than'
with '.tool.segments[0].length_m = 1' '/tool/segments/0/length_m: unknown field: expected length_mm'
with '.materials.steel.poisson_ratio = 0.6' '/materials/steel/poisson_ratio: 0.6: expected'
with '.beam_theory = "rayleigh"' '/beam_theory: "rayleigh": expected "timoshenko" or "euler-bernoulli"'
with '.holder = "free"' '/holder: "free": expected "fixed"'
with '.holder = {end: "free"}' '/holder/segments: missing'
with '.holder = {end: "free", segments: []}' '/holder/segments: a list of 0: expected'
with '.holder.end = "pinned"' '/holder/end: "pinned": expected "fixed" or "free"'
with '.holder = {segments: .holder.segments}' '/holder/end: missing'
with '.sensor_mass_g = -1' '/sensor_mass_g: -1: expected a number not below 0'
with '.tool.segments[0].flutes = 0' '/tool/segments/0/flutes: 0: expected a whole number from 1'
with '.tool.segments[0].equivalent_diameter_mm = 13' '/tool/segments/0/equivalent_diameter_mm: 13: expected at most outer_diameter_mm'
with '.tool.segments[0] |= (.flutes = 2 | .inner_diameter_mm = 10)' '/tool/segments/0/inner_diameter_mm: 10: expected less than the equivalent diameter'
with '.holder = {x: .holder}' '/holder/y: missing'
with '.joint = "glued"' '/joint: "glued": expected "rigid"'
with '.joint.k1_n_per_m = -1' '/joint/k1_n_per_m: -1: expected a number above 0'
with '.frequency_hz.from = 0' '/frequency_hz/from: 0: expected a number above 0'
with '.frequency_hz = [1e80]' '/frequency_hz: 1e.80: the receptance is not finite: expected'
with '.frequency_hz = [3, 2]' '/frequency_hz/1: 2: expected increasing'
with '.format = "stablecut/frf/1"' '/format: .*expected "stablecut/assembly/1"'
check "nothing was written" test ! -e result.json

# A sensor sits on the tip, and other places know nothing of it.
jq '.sensor_mass_g = 5' "$data/liu-assembly.json" >sensor.json
refused 65 '^rcsa-couple: sensor.json: /sensor_mass_g: with --positions: expected no sensor on the tip$' rcsa-couple --positions 0,10 sensor.json

jq '.frequency_hz = {from: 1, to: 2, count: 1}' "$data/liu-assembly.json" >point.json
refused 65 '^rcsa-couple: point.json: /frequency_hz/to: 2: expected the same number as from, since count is 1$' rcsa-couple point.json
