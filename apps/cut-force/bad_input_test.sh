#!/usr/bin/env bash
# Bad input to cut-force: the right exit status, one line that names the place, nothing half-written.
. "$SOURCE/apps/testing.sh"
table=$data/thesis-table-6-2.json tool=$data/slotting-tool.json forces=$data/slot-forces.csv
jq '.feed_per_tooth_mm = 0.1' "$data/thesis-cut.json" >cut.json

# with FILTER PLACE: the cut changed by a jq filter is refused with that place and status 65.
with() {
  jq "$1" cut.json >changed.json
  refused 65 "^cut-force: changed.json: $2" cut-force changed.json -o result.json
}
with 'del(.feed_per_tooth_mm)' '/feed_per_tooth_mm: missing: expected a feed above 0'
with 'del(.kt_n_per_mm2)' '/kt_n_per_mm2: missing'
with '.kt_kr_correlation = 1.1' '/kt_kr_correlation: 1.1: expected a correlation from -1 to 1'
with '.kae_std_n_per_mm = -1' '/kae_std_n_per_mm: -1: expected a number not below 0'
with '.runout_um = [1]' '/runout_um: .*expected 2 numbers'
with '.format = "stablecut/lobes/1"' '/format: "stablecut/lobes/1": expected "stablecut/cut/1"'
refused 65 '^cut-force: <stdin>: empty input' cut-force </dev/null
jq '.dofs = ["z", "w"]' "$table" >axial.json
refused 65 '^cut-force: axial.json: /dofs: .*expected x, y or both' cut-force cut.json --table axial.json --depth 1 --speed 9000
jq '.modes |= map(.psi_l |= map([0, 0]))' "$table" >dead.json
refused 65 '^cut-force: dead.json: /modes: expected at least one mode' cut-force cut.json --table dead.json --depth 1 --speed 9000
printf 'depth_mm,speed_rpm\n1,x\n' >points.csv
refused 65 '^cut-force: points.csv: line 2: "x": expected a speed' cut-force cut.json --table "$table" --points points.csv
printf 'depth_mm,speed_rpm\n' >none.csv
refused 65 '^cut-force: none.csv: expected one cut at least' cut-force cut.json --table "$table" --points none.csv
refused 1 '^cut-force: at 0.01 rpm the fastest mode turns too often to be simulated' cut-force cut.json --table "$table" --depth 1 --speed 0.01
printf 'depth_mm,speed_rpm\n1,0.01\n1,20000\n' >slow.csv
cut-force cut.json --table "$table" --points slow.csv -o slow.json 2>said
check "a point without an answer is said" grep -q 'warning: slow.csv: at 0.01 rpm .*points without an answer: 1' said
check_jq "and null, and the other is there" slow.json '.points[0].growth_per_tooth == null and (.points[0] | has("not_simulated")) and .points[1].stable'

refused 64 '^cut-force: --depth: 0: expected a number above 0' cut-force cut.json --depth 0
refused 64 '^cut-force: --speed: nan: expected' cut-force cut.json --speed nan
refused 64 '^cut-force: --harmonics: 2000000000: expected a whole number from 0 to 100000' cut-force cut.json --harmonics 2000000000
refused 64 '^cut-force: --passes, --steps: 2000000000: expected at most 1000000000 steps of all cuts' \
  cut-force cut.json --passes 2000000000 --table "$table" --depth 1 --speed 9000
refused 64 '^cut-force: --steps: 4: expected' cut-force cut.json --steps 4 --table "$table" --depth 1 --speed 9000
refused 64 '^cut-force: --points: expected with --table' cut-force cut.json --points points.csv
refused 64 '^cut-force: --table: expected --points, or --depth and --speed' cut-force cut.json --table "$table"
jq '.lead_angle_deg = 45' cut.json >inclined.json
refused 64 '^cut-force: --table: expected a cut without lead_angle_deg' cut-force inclined.json --table "$table" --depth 1 --speed 9000
refused 64 '^cut-force: --identify: expected a cut without lead_angle_deg' cut-force inclined.json --identify "$data/slot-forces.csv"
jq '.dofs += ["z"] | .modes[] |= (.psi_r += [.psi_r[0]] | .psi_l += [.psi_l[0]])' "$table" >with-z.json
jq '.ka_n_per_mm2 = 100' cut.json | cut-force --table with-z.json --depth 0.2 --speed 9000 -o z.json 2>said
check "z that does not take part is said" grep -q 'with-z.json: /dofs: "z": left out' said
refused 64 '^cut-force: --passes, --steps, --from-rest, --tooth-paths: expected with --table' cut-force cut.json --from-rest
refused 64 '^cut-force: --identify: expected without --depth' cut-force "$tool" --identify "$forces" --depth 1
refused 64 '^cut-force: --edges: expected with --identify' cut-force cut.json --edges cut
refused 64 '^cut-force: --edges: none: expected fit\|cut' cut-force "$tool" --identify "$forces" --edges none
refused 64 '^cut-force: --force-on: expected with --identify' cut-force cut.json --force-on tool
refused 64 '^cut-force: -: expected standard input for one input only' cut-force --identify - <"$tool"

# forces_with SED PLACE: the table of forces changed is refused with that place.
forces_with() {
  sed "$1" "$forces" >forces.csv
  refused 65 "^cut-force: forces.csv: $2" cut-force --identify forces.csv "$tool" -o result.json
}
forces_with '1d' 'line 1: expected a header that names the columns'
forces_with '1s/fx_n/fx_kn/' 'line 1: "fx_kn": expected fx_n'
forces_with '1s/depth_mm/depth_um/' 'line 1: expected a column depth_mm'
forces_with '1s/fx_n,fy_n,fz_n/a,b,c/' 'line 1: expected columns fx_n, fy_n, fz_n'
forces_with '2,$d' 'line 1: expected rows below the header'
forces_with '3s/,1,3000/,-1,3000/' 'line 3: -1: expected a depth above 0 mm'
forces_with '3s/,0.05,/,0,/' 'line 3: 0: expected a feed above 0 mm'
forces_with '3s/^[^,]*/x/' 'line 3: "x": expected a force in N'
forces_with '1s/speed_rpm/entry_deg/' 'line 1: expected both entry_deg and exit_deg'
forces_with '1s/speed_rpm/milling/' 'line 1: expected both radial_immersion and milling'
printf 'fx_n,fy_n,feed_per_tooth_mm,depth_mm,milling,radial_immersion\n1,2,0.1,1,sideways,0.5\n' >forces.csv
refused 65 '^cut-force: forces.csv: line 2: "sideways": expected up or down' cut-force --identify forces.csv "$tool"
printf 'record,depth_mm,speed_rpm\nmissing.csv,1,3000\n' >list.csv
refused 66 '^cut-force: missing.csv: cannot be read' cut-force --identify list.csv "$tool"
printf 'record,depth_mm\na.csv,1\n' >list.csv
refused 65 '^cut-force: list.csv: line 1: expected a column speed_rpm' cut-force --identify list.csv "$tool"
printf 'time_s,fx_n,fy_n\n0,1,1\n0.001,1,1\n0.002,1,1\n' >short.csv
printf 'record,depth_mm,speed_rpm\nshort.csv,1,3000\n' >list.csv
refused 65 '^cut-force: short.csv: line 1: expected one revolution at least, 0.02 s' cut-force --identify list.csv "$tool"
printf 'time_s,fx_n,fy_n\n0,1,1\n0.01,1,1\n0.05,1,1\n' >short.csv
refused 65 '^cut-force: short.csv: line 3: 0.01: expected times in equal steps' cut-force --identify list.csv "$tool"
check "nothing was written" test ! -e result.json
refused 74 '^cut-force: /dev/full: cannot be written' cut-force cut.json -o /dev/full
refused 73 '^cut-force: none/x.json: cannot be created' cut-force cut.json -o none/x.json

# Tables of cuts and of forces.
: >empty.csv
refused 65 '^cut-force: empty.csv: empty input: expected depth_mm,speed_rpm' cut-force cut.json --table "$table" --points empty.csv
printf 'depth,speed\n1,2\n' >head.csv
refused 65 '^cut-force: head.csv: line 1: expected columns depth_mm and speed_rpm in the header$' cut-force cut.json --table "$table" --points head.csv
printf 'depth_mm,speed_rpm\n1,0\n' >still.csv
refused 65 '^cut-force: still.csv: line 2: 0: expected a speed above 0 rpm$' cut-force cut.json --table "$table" --points still.csv
awk -F, 'BEGIN {OFS = ","} {print $0, NR == 1 ? "entry_deg" : 90, NR == 1 ? "exit_deg" : 80}' "$data/slot-forces.csv" >arc.csv
refused 65 '^cut-force: arc.csv: line 2: 80: expected an angle above entry_deg$' cut-force --identify arc.csv "$data/slotting-tool.json"
cut -d, -f1-3,5- "$data/slot-forces.csv" >no-feed.csv
jq 'del(.feed_per_tooth_mm)' "$data/slotting-tool.json" >no-feed.json
refused 65 '^cut-force: no-feed.csv: line 1: expected a column feed_per_tooth_mm, or feed_per_tooth_mm in the cut$' cut-force --identify no-feed.csv no-feed.json
