#!/usr/bin/env bash
# rcsa-couple --identify: the published case, directions, noise, what cannot be told, bad input.
. "$SOURCE/apps/testing.sh"
assembly=$data/liu-assembly.json
rcsa-couple "$assembly" -o joint.json
jq '.joint = "rigid"' "$assembly" | rcsa-couple -o rigid.json
near='def near(value; share): (. / value - 1 | fabs) < share;'

rcsa-couple --identify joint.json "$assembly" -o found.json
check_jq "all four values to 1e-6, in x and in y" found.json "$near"' .x == .y and (.x | (.k1_n_per_m | near(97062227; 1e-6)) and (.c1_n_s_per_m | near(18.633; 1e-6))
  and (.k2_n_m_per_rad | near(95978423; 1e-6)) and (.c2_n_m_s_per_rad | near(10.399; 1e-6)) and .identifiable == [true, true, true, true] and .at_bound == [false, false, false, false])'
rcsa-couple --joint found.json --no-provenance "$assembly" -o again.json
check_jq "the joint couples to the tip it came from" again.json '[.h[0].re, $tip[0].h[0].re] | transpose | all((.[0] - .[1] | fabs) <= 1e-9 * (.[1] | fabs))' --slurpfile tip joint.json

bounds=(--bounds "k1=1e5:1e8,c1=0:100" --bounds "k2=1e5:1e8,c2=0:100")
rcsa-couple --identify rigid.json --objective amplitude "${bounds[@]}" "$assembly" -o bound.json 2>log
check_jq "the rigid cantilever within the paper's bounds" bound.json '.x | (.objective.value_m_per_n * 1e5 | . > 6.6 and . < 6.625) and .objective.name == "amplitude" and .at_bound[0:3] == [true, true, true] and .std.k1_n_per_m == null'
for name in k1 c1 k2; do check "it says that $name is at its bound" grep -q "$name lies at its bound" log; done

# One direction; lines between those of the assembly; a band by the assembly.
jq '.h |= [.[3]] | .frequency_hz |= .[99:4000] | .h[0].re |= .[99:4000] | .h[0].im |= .[99:4000]' joint.json >one.json
jq '.frequency_hz = [200, 3000]' "$assembly" | rcsa-couple --identify one.json -o one-found.json
check_jq "one direction, its name, lines and band" one-found.json "$near"' .direction == "y" and .lines == 2801 and .band_hz == [200, 3000] and (.k1_n_per_m | near(97062227; 1e-4))'
rcsa-couple --joint one-found.json "$assembly" -o one-used.json 2>log
check "one direction's joint serves both, and says so" grep -q 'one-found.json: identified in y only: taken for x as well' log
jq '.joint = {x: .joint, y: (.joint | .k1_n_per_m = 2e7)}' "$assembly" | rcsa-couple -o two.json
rcsa-couple --identify two.json "$assembly" --fitted fitted.json --rigid without.json -o two-found.json
check_jq "x and y apart" two-found.json "$near"' (.x.k1_n_per_m | near(97062227; 1e-6)) and (.y.k1_n_per_m | near(2e7; 1e-6))'
check_jq "the fitted tip is the measured one" fitted.json '[.h[3].re, $tip[0].h[3].re] | transpose | all((.[0] - .[1] | fabs) <= 1e-9 * (.[1] | fabs))' --slurpfile tip two.json
check_jq "without the joint" without.json '.h[0].re == $rigid[0].h[0].re' --slurpfile rigid rigid.json
jq '.sensor_mass_g = 3' "$assembly" | rcsa-couple -o heavy.json
jq '.sensor_mass_g = 3' "$assembly" | rcsa-couple --identify heavy.json -o heavy-found.json
check_jq "through a sensor's mass" heavy-found.json "$near"' (.x.k1_n_per_m | near(97062227; 1e-6)) and (.x.c2_n_m_s_per_rad | near(10.399; 1e-4))'

# A noisy tap of a real set-up, whose spindle is noisy too.
rcsa-couple --quiet --identify "$data/carbide-tap.json" "$data/carbide-in-collet.json" -o tap.json
check_jq "a noisy tap: the joint behind it within four deviations" tap.json 'def far(truth): [.k1_n_per_m, .k2_n_m_per_rad] as [$a, $b] | [($a - truth[0]) / .std.k1_n_per_m, ($b - truth[1]) / .std.k2_n_m_per_rad] | map(fabs) | max;
  (.x | far([4e7, 1.5e4])) < 4 and (.y | far([4.6e7, 1.3e4])) < 4 and (.x.identifiable | all)'
rcsa-couple --threads 1 --quiet --identify "$data/carbide-tap.json" "$data/carbide-in-collet.json" -o one-thread.json
check "same bytes on one and two threads" cmp -s tap.json one-thread.json
check_jq "provenance of tap, assembly and spindle" tap.json '.provenance.inputs | length == 3'

# A stiff joint under noise: its damping cannot be told.
jq '.joint = {k1_n_per_m: 5e8, c1_n_s_per_m: 500, k2_n_m_per_rad: 1e6, c2_n_m_s_per_rad: 2}' "$assembly" | rcsa-couple --no-provenance |
  jq '(.h[0] | [.re, .im] | transpose | map(.[0] * .[0] + .[1] * .[1]) | add / length | sqrt) as $rms | .h |= [.[0]]
    | .h[0].re |= [foreach .[] as $v ({s: 1}; .s = (.s * 48271 % 2147483647) | .v = $v + $rms * 0.01225 * (.s / 2147483647 - 0.5) * 1.999; .v)]
    | .h[0].im |= [foreach .[] as $v ({s: 7}; .s = (.s * 48271 % 2147483647) | .v = $v + $rms * 0.01225 * (.s / 2147483647 - 0.5) * 1.999; .v)]' >stiff.json
rcsa-couple --identify stiff.json "$assembly" -o stiff-found.json 2>log
check_jq "stiffness yes, damping no" stiff-found.json '.identifiable == [true, false, true, false]'
check "and says so" grep -Eq 'c1 (is not identifiable: its standard deviation is [0-9]+ %|lies at its bound)' log

# Whoever takes such values hears of each.
rcsa-couple --joint found.json "$assembly" -o silent.json 2>log
check "nothing is said of values that are told" test ! -s log
unknown='; what it does at another overhang or in another band is not known$'
jq '.x.identifiable[1] = false | .x.c1_n_s_per_m = 20 | .x.std.c1_n_s_per_m = 9 | .y = .x' found.json >untold.json
rcsa-couple --joint untold.json "$assembly" -o used.json 2>log
check "a value that is not told, once for both" test "$(wc -l <log)" = 1
check "its place, value and deviation" grep -q "^rcsa-couple: warning: untold.json: /x/c1_n_s_per_m and in y: 20: is not identifiable: its standard deviation is 45 % of its value$unknown" log
jq '.y.identifiable[1] = true | .y.identifiable[3] = false | .y.at_bound[3] = true | .y.c2_n_m_s_per_rad = 0 | .y.std.c2_n_m_s_per_rad = null | del(.x.std)' untold.json >apart.json
rcsa-couple --joint apart.json "$assembly" -o used.json 2>log
check "in x and y apart" test "$(wc -l <log)" = 2
check "in x, without its deviation" grep -q "apart.json: /x/c1_n_s_per_m: 20: is not identifiable$unknown" log
check "in y, at its bound" grep -q "apart.json: /y/c2_n_m_s_per_rad: 0: lies at its bound$unknown" log
rcsa-couple --joint stiff-found.json "$assembly" -o used.json 2>log
check "of one direction" grep -Eq "stiff-found.json: /c1_n_s_per_m: .*$unknown" log

# A rigid joint: nothing can be told, and no numbers come. With bounds that somebody chose, one that lies at them is an answer.
jq '.joint = "rigid" | .frequency_hz = {from: 100, to: 2000, count: 200}' "$data/liu-assembly.json" >rigid-assembly.json
rcsa-couple rigid-assembly.json -o rigid-tip.json
refused 1 "^rcsa-couple: x and y: the measured tip, rigid-tip.json, does not determine any" \
  rcsa-couple --identify rigid-tip.json rigid-assembly.json
rcsa-couple --quiet --identify rigid-tip.json rigid-assembly.json --bounds k1=1e3:1e10 -o chosen.json
check_jq "a chosen bound" chosen.json '.x | .at_bound[0] and .k1_n_per_m == 1e10'

# Lines that claim to be sure (a coherence rounded to 1) do not outweigh the others.
jq '.h[] |= (([.re, .im] | transpose | map(.[0] * .[0] + .[1] * .[1]) | add / length * 1e-4) as $v
  | .variance = [range(.re | length) | if . % 100 == 7 then 0 else $v end])' "$data/carbide-tap.json" >sure.json
rcsa-couple --quiet --identify sure.json "$data/carbide-in-collet.json" -o sure-found.json
check_jq "a variance of 0 is not believed to the letter" sure-found.json "$near"' .x | (.k1_n_per_m | near(4e7; 0.05)) and (.c1_n_s_per_m | near(150; 0.3)) and (.k2_n_m_per_rad | near(1.5e4; 0.02))'

# The tip from whatever the laboratory has.
fit-modes --convert --to uff "$data/carbide-tap.json" -o tap.uff
fit-modes --convert "$data/carbide-tap.json" | jq -r '.h[] |= del(.variance) | .frequency_hz as $f | "f_hz,Re(Hxx),Im(Hxx),Re(Hyy),Im(Hyy)",
  (range($f | length) as $i | [$f[$i], (.h[] | 1e6 * .re[$i], 1e6 * .im[$i])] | @csv)' >tap.csv
jq '.h[] |= del(.variance)' "$data/carbide-tap.json" >plain.json
for form in "plain.json" "tap.uff" "tap.csv --unit um/N"; do
  # shellcheck disable=SC2086
  rcsa-couple --quiet --identify $form "$data/carbide-in-collet.json" --no-provenance -o "form-${form:0:5}.json"
done
for form in tap.u tap.c; do
  check_jq "$form: the same joint" form-$form.json '[paths(numbers) as $p | [getpath($p), ($p | . as $q | $other[0] | getpath($q))]
    | select((.[0] - .[1] | fabs) > 1e-5 * (.[1] | fabs))] | length == 0' --slurpfile other form-plain.json
done
# What is said of a file names options that this tool has.
sed 's/Displacement         m   /Displacement         V   /' tap.uff >volts.uff
rcsa-couple --identify volts.uff "$data/carbide-in-collet.json" -o volts.json 2>log
check "a unit that is not known" grep -Eq '^rcsa-couple: warning: volts.uff: line [0-9]+ \(function 1, record 9\): V over N: .* is believed \(--unit\)$' log
rcsa-couple --identify "$data/taps/nodes.uff" "$data/carbide-in-collet.json" >nodes.json 2>log
check "no option for what it cannot choose" grep -Eq 'a direction is named with its node, as x@1$' log
refused 64 '^rcsa-couple: --unit: a frf document says its units itself' rcsa-couple --identify plain.json --unit um/N "$data/carbide-in-collet.json"
refused 64 '^rcsa-couple: --unit: expected only with --identify' rcsa-couple "$assembly" --unit um/N

refused 64 '^rcsa-couple: --fitted: expected only with --identify' rcsa-couple "$assembly" --fitted x.json
refused 64 '^rcsa-couple: --bounds: expected only with --identify' rcsa-couple "$assembly" --bounds k1=1:2
refused 64 '^rcsa-couple: --bounds: k3=1:2: expected' rcsa-couple --identify joint.json "$assembly" --bounds k3=1:2
refused 64 '^rcsa-couple: --bounds: k1=0:2: expected' rcsa-couple --identify joint.json "$assembly" --bounds k1=0:2
refused 64 '^rcsa-couple: --bounds: k1=2:1: expected' rcsa-couple --identify joint.json "$assembly" --bounds c1=0:1,k1=2:1
refused 64 '^rcsa-couple: --objective: phase: expected' rcsa-couple --identify joint.json "$assembly" --objective phase
refused 64 '^rcsa-couple: --joint: expected only without --identify' rcsa-couple --identify joint.json --joint found.json "$assembly"
refused 64 '^rcsa-couple: -: expected standard input for one input only' rcsa-couple --identify - <joint.json
refused 66 '^rcsa-couple: none.json: cannot be read' rcsa-couple --identify none.json "$assembly"
refused 65 '^rcsa-couple: found.json: /format: .*expected "stablecut/frf/1"' rcsa-couple --identify found.json "$assembly"
refused 65 '^rcsa-couple: joint.json: /format: .*expected "stablecut/tool-joint/1"' rcsa-couple --joint joint.json "$assembly"
jq '.x.k1_n_per_m = -1' found.json >bad.json
refused 65 '^rcsa-couple: bad.json: /x/k1_n_per_m: -1: expected a number above 0' rcsa-couple --joint bad.json "$assembly"
jq '.h |= [.[1]]' joint.json >cross.json
refused 65 '^rcsa-couple: cross.json: /h: expected an entry xx or yy at the tip' rcsa-couple --identify cross.json "$assembly"
jq '.frequency_hz |= map(. + 6000)' joint.json >far.json
refused 65 '^rcsa-couple: far.json: /frequency_hz: 0 lines: expected at least 4 within' rcsa-couple --identify far.json "$assembly"
jq '.frequency_hz = [10, 12]' "$assembly" >few.json
refused 65 '^rcsa-couple: joint.json: /frequency_hz: 3 lines: expected at least 4 within' rcsa-couple --identify joint.json few.json
jq '.h[0].re |= map(. * 1000) | .h[3].re |= map(. * 1000)' joint.json >units.json
refused 1 '^rcsa-couple: x.*: the best joint leaves .* unexplained' rcsa-couple --identify units.json "$assembly"
jq '.modes[] |= (.psi_r[2] = .psi_r[0] | .psi_l = .psi_r)' "$data/spindle-modes.json" >coupled.json
jq '.holder = {modal_table: {file: "coupled.json"}}' "$assembly" >couples.json
refused 65 '^rcsa-couple: couples.json: /holder: couples x and y' rcsa-couple --identify joint.json couples.json
