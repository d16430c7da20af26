#!/usr/bin/env bash
# What every tool writes in the place of its document: aligned text, and tables for spreadsheets, numpy and Octave.
. "$(dirname "$0")/../testing.sh"
data=$SOURCE/testdata
chart=("$data/thesis-table-6-2.json" --cut "$data/thesis-cut.json" --speed 9000:12000:4 --depth 0:1:3 --quiet)
sdm-lobes "${chart[@]}" -o lobes.json
sdm-lobes "${chart[@]}" --csv limit -o limit.csv
sdm-lobes "${chart[@]}" --csv grid -o grid.csv
sdm-lobes "${chart[@]}" --table -o table.txt
check_jq "a row of CSV is a row of the document" lobes.json '[.limit[] | [.speed_rpm, .depth_mm, .kind]]
  == [$csv | split("\n")[1:][] | select(. != "") | split(",") | [(.[0] | tonumber), (.[1] | if . == "" then null else tonumber end),
      (.[3] | if . == "" then null else . end)]]' \
  --rawfile csv limit.csv
check "all rows of the limit have the same fields" test "$(jq '[.limit[] | keys] | unique | length' lobes.json)" = 1
check_jq "and some have no limit" lobes.json '[.limit[] | .depth_mm == null] | any and (all | not)'
check "aligned" grep -qE '^ +9000  +-  +-' table.txt
check "the table of a chart has every grid point" test "$(wc -l <grid.csv)" = 13
refused 64 '^sdm-lobes: --csv: nonsense: expected a table of this document: document, limit, crossings' sdm-lobes "${chart[@]}" --csv nonsense
refused 64 '^sdm-lobes: .*--csv' sdm-lobes "${chart[@]}" --csv limit --table
refused 64 '^fit-modes: --csv: expected an output that is a document' fit-modes --synthesize 1:9:3 --to uff --csv h "$data/thesis-table-6-2.json"

check "modes" grep -q '^frequency_hz,damping_ratio,psi_r_1_re,psi_r_1_im' <(fit-modes "$data/taps/findings/sound.csv" --quiet --csv modes)
check "lines" grep -q '^frequency_hz,h_x_x_re,h_x_x_im' <(fit-modes --synthesize 1:9:30 "$data/thesis-table-6-2.json" --csv frequency_hz)
robot=$data/kr360.json
check "joints" grep -qE '^joints,stiffness_n_m_per_rad,' <(joint-stiffness --robot "$robot" "$data/kr360-loads.csv" --quiet --csv joints)
jq '.feed_per_tooth_mm = 0.1' "$data/thesis-cut.json" >fed.json
check "forces, under the name that cut-force has left" grep -q '^  *power_w' <(cut-force fed.json --depth 1 --speed 9000 --as-table)
check "receptances" grep -q '^frequency_hz,h_x_x_re' <(rcsa-couple "$data/liu-assembly.json" --quiet --csv frequency_hz)

# As the manual says.
if /usr/bin/python3 -c 'import numpy' 2>/dev/null; then
  check "numpy" /usr/bin/python3 -c '
import json, numpy
limit = numpy.genfromtxt("limit.csv", delimiter=",", names=True, dtype=None, encoding="utf-8")
chart = json.load(open("lobes.json"))
assert limit["speed_rpm"].tolist() == chart["speed_rpm"]
assert [None if numpy.isnan(d) else d for d in limit["depth_mm"]] == [row["depth_mm"] for row in chart["limit"]]
assert numpy.array(chart["spectral_radius"], dtype=float).shape == (3, 4)'
else
  echo "numpy: skipped, not installed"
fi
if command -v octave-cli >/dev/null; then
  check "Octave" octave-cli --no-gui --quiet --eval '
    grid = dlmread("grid.csv", ",", 1, 0); chart = jsondecode(fileread("lobes.json"));
    assert(isstruct(chart.limit) && numel(chart.limit) == 4 && isequal(size(chart.spectral_radius), [3 4]));
    assert(reshape(grid(:, 3), 3, 4), chart.spectral_radius, 1e-15);
    stable = arrayfun(@(row) isempty(row.depth_mm), chart.limit); assert(any(stable) && !all(stable));'
else
  echo "Octave: skipped, not installed"
fi
