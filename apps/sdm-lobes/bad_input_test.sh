#!/usr/bin/env bash
# Bad input to sdm-lobes: the right exit status, one line that names the place, nothing half-written.
. "$SOURCE/apps/testing.sh"
table=$data/thesis-table-6-2.json cut=$data/thesis-cut.json

# cut_with FILTER PLACE: the cut changed by a jq filter is refused with that place and status 65.
cut_with() {
  jq "$1" "$cut" >cut.json
  refused 65 "^sdm-lobes: cut.json: $2" sdm-lobes --cut cut.json "$table" -o result.json
}
cut_with '.teeth = 0' '/teeth: 0: expected a whole number from 1'
cut_with '.teeth = 2.5' '/teeth: 2.5: expected'
cut_with '.teeth = "2"' '/teeth: "2": expected'
cut_with 'del(.teeth)' '/teeth: missing'
cut_with '.kt_n_per_mm2 = -1' '/kt_n_per_mm2: -1: expected a number above 0'
cut_with '.kt_n_per_mm2 = null' '/kt_n_per_mm2: null: expected'
cut_with '.milling = "sideways"' '/milling: "sideways": expected "up" or "down"'
cut_with '.radial_immersion = 0' '/radial_immersion: 0: expected'
cut_with '.radial_immersion = 1.5' '/radial_immersion: 1.5: expected'
cut_with 'del(.radial_immersion)' '/radial_immersion: missing'
cut_with 'del(.radial_immersion) | .entry_deg = 90 | .exit_deg = 60' '/exit_deg: 60: expected an angle above entry_deg'
cut_with 'del(.radial_immersion) | .entry_deg = -5 | .exit_deg = 60' '/entry_deg: -5: expected'
cut_with '.chart.depth_mm.from = -1' '/chart/depth_mm/from: -1: expected a depth from 0'
cut_with '.chart.speed_rpm.from = 0' '/chart/speed_rpm/from: 0: expected a number above 0'
cut_with '.chart.speed_rpm.to = 10' '/chart/speed_rpm/to: 10: expected a number above from'
cut_with '.kt_n_per_mm = 1' '/kt_n_per_mm: unknown field: expected kt_n_per_mm2'
cut_with '.theeth = 2' '/theeth: unknown field: expected teeth'
cut_with '.helix_deg = 30 | del(.diameter_mm)' '/helix_deg: 30: expected diameter_mm'
cut_with '.diameter_mm = 1e5' '/diameter_mm: 100000.*: expected a diameter above 0, of at most 10000 mm'
cut_with '.helix_deg = 90' '/helix_deg: 90: expected a helix angle'
cut_with '.helix_deg = 89.9999' '/helix_deg: 89.9999: expected an edge that turns by less'
cut_with '.helix_deg = [30]' '/helix_deg: .*expected 2 angles'
cut_with '.helix_deg = [30, 91]' '/helix_deg/1: 91: expected a helix angle'
cut_with '.helix_deg = [30, 31] | .runout_um = [1, -1]' '/helix_deg: .*expected one angle where there is runout_um'
cut_with '.pitch_deg = [120, 120, 120]' '/pitch_deg: .*expected 2 angles'
cut_with '.process_damping_n_per_m = 1e5 | del(.diameter_mm)' '/process_damping_n_per_m: .*expected diameter_mm'
cut_with '.process_damping_friction = 0.3' '/process_damping_friction: 0.3: expected process_damping_n_per_m'
cut_with '.feed_per_tooth_mm = 0' '/feed_per_tooth_mm: 0: expected a number above 0'
cut_with '.kt_std_n_per_mm2 = -1' '/kt_std_n_per_mm2: -1: expected a number not below 0'
cut_with '.pitch_deg = [170, 100]' '/pitch_deg: .*expected angles that sum to 360'
cut_with '.format = "stablecut/cut/2"' '/format: "stablecut/cut/2": expected "stablecut/cut/1"'
cut_with '.remark = 1' '/remark: unknown field: expected chart '
cut_with '.hleix_deg = 1' '/hleix_deg: unknown field: expected helix_deg '
jq '.x_note = "free"' "$cut" >cut.json
check "fields of the user's own" sdm-lobes --cut cut.json "$table" --speed 9000:9000:1 --depth 1:1:1 -o free.json

# table_with FILTER PLACE: the same for the modal table.
table_with() {
  jq "$1" "$table" >table.json
  refused 65 "^sdm-lobes: table.json: $2" sdm-lobes --cut "$cut" table.json -o result.json
}
table_with '.modes[3].frequency_hz = "x"' '/modes/3/frequency_hz: "x": expected a frequency'
table_with '.modes[3].damping_ratio = 0' '/modes/3/damping_ratio: 0: expected'
table_with '.modes[3].damping_ratio = 1' '/modes/3/damping_ratio: 1: expected'
table_with 'del(.modes[0].psi_l)' '/modes/0/psi_l: missing'
table_with '.modes[2].psi_r = [[1, 2]]' '/modes/2/psi_r: a list of 1: expected 2 complex'
table_with '.modes[2].psi_r[1] = [1, 2, 3]' '/modes/2/psi_r/1: a list of 3: expected a complex number'
table_with '.modes = []' '/modes: a list of 0: expected'
table_with '.dofs = ["z", "w"]' '/dofs: .*expected x, y or both'
table_with '.dofs = ["x", "x"]' '/dofs/1: "x": expected'
table_with '.format = "stablecut/frf/1"' '/format: "stablecut/frf/1": expected "stablecut/modal-table/1"'
refused 65 '^sdm-lobes: <stdin>: empty input' sdm-lobes --cut "$cut" </dev/null
refused 65 '^sdm-lobes: .*/entry-xx.csv: line 1: not a modal table: expected what fit-modes makes of a tap' sdm-lobes --cut "$cut" "$data/taps/entry-xx.csv"
head -c 700 "$table" >truncated.json
refused 65 '^sdm-lobes: truncated.json: line [0-9]+: /modes/.*the document ends here' sdm-lobes --cut "$cut" truncated.json
sed 's/7.67,/NaN,/' "$table" >nan.json
refused 65 '^sdm-lobes: nan.json: line [0-9]+: /modes/0/frequency_hz: NaN' sdm-lobes --cut "$cut" nan.json
sed 's/7.67,/1e999,/' "$table" >huge.json
refused 65 '^sdm-lobes: huge.json: .*/modes/0/frequency_hz' sdm-lobes --cut "$cut" huge.json
sed 's/"dofs"/"dofs": [], "dofs"/' "$table" >twice.json
refused 65 '^sdm-lobes: twice.json: /dofs: duplicate key' sdm-lobes --cut "$cut" twice.json
# Options that do not go together, and parts that are not parts.
small=(--cut "$cut" "$table" --speed 9000:12000:4 --depth 0:1:3)
refused 64 '^sdm-lobes: --shard: 3/2: expected K/N' sdm-lobes "${small[@]}" --shard 3/2
refused 64 '^sdm-lobes: --shard: x: expected K/N' sdm-lobes "${small[@]}" --shard x
refused 64 '^sdm-lobes: --shard: expected at most as many parts as speeds, 4' sdm-lobes "${small[@]}" --shard 1/5
refused 64 '^sdm-lobes: --seed: expected with --samples' sdm-lobes "${small[@]}" --seed 2
refused 64 '^sdm-lobes: --samples: expected with --method spectral' sdm-lobes "${small[@]}" --samples 10 --method sdm
refused 64 '^sdm-lobes: --max-power: expected feed_per_tooth_mm' sdm-lobes "${small[@]}" --max-power 500
jq '.pitch_deg = [170, 190]' "$cut" >uneven.json
refused 64 '^sdm-lobes: --method: sdm: expected straight teeth of equal pitch' sdm-lobes "$table" --cut uneven.json --method sdm
sdm-lobes "${small[@]}" --shard 1/2 -o part1.json
sdm-lobes "${small[@]}" --shard 2/2 -o part2.json
sdm-lobes "${small[@]}" -o whole.json
refused 65 '^sdm-lobes: part1.json: /shard/count: 2: expected 1' sdm-lobes "${small[@]}" --merge part1.json
refused 65 '^sdm-lobes: part1.json: /shard/index: 1: expected each part once' sdm-lobes "${small[@]}" --merge part1.json --merge part1.json
refused 65 '^sdm-lobes: whole.json: /shard: missing' sdm-lobes "${small[@]}" --merge whole.json --merge part1.json
jq '.modes[0].frequency_hz = 7' "$table" >other-table.json
refused 65 '^sdm-lobes: part1.json: /shard/of: .*expected the inputs and options of this run' sdm-lobes --cut "$cut" other-table.json \
  --speed 9000:12000:4 --depth 0:1:3 --merge part1.json --merge part2.json
refused 64 '^sdm-lobes: -: expected standard input for one input only' sdm-lobes --cut - <"$cut"
refused 1 '^sdm-lobes: at 20.* rpm the fastest mode turns too often' sdm-lobes --cut "$cut" "$table" --speed 20:20:1 --depth 0:1:3
jq '.kt_n_per_mm2 = 700' "$cut" >other.json
refused 65 '^sdm-lobes: part1.json: /cut: .*expected the cut and chart of this run' sdm-lobes --cut other.json "$table" \
  --speed 9000:12000:4 --depth 0:1:3 --merge part1.json --merge part2.json
refused 65 '^sdm-lobes: part1.json: /spectral_radius: .*expected a grid as in this run' sdm-lobes "${small[@]}" --limit-only --merge part1.json --merge part2.json
part_with() {
  jq "$1" part1.json >changed.json
  refused 65 "^sdm-lobes: changed.json: $2" sdm-lobes "${small[@]}" --merge changed.json --merge part2.json
}
part_with '.method = "sdm"' '/method: "sdm": expected the method of this run'
part_with '.speed_rpm[0] = 1' "/speed_rpm: a list of 2: expected this part's speeds"
part_with '.depth_mm |= .[1:]' '/depth_mm: a list of 2: expected the depths of this run'
part_with '.samples = 5' '/samples: 5: expected the number of samples of this run'
part_with '.spectral_radius |= .[1:]' '/spectral_radius: a list of 2: expected 3 rows, one for each depth'
part_with '.spectral_radius[1] |= .[1:]' '/spectral_radius/1: a list of 1: expected a number for each speed'
part_with '.limit |= .[1:]' '/limit: a list of 1: expected an entry for each speed'
part_with '.crossings = [{speed_rpm: 1}]' "/crossings/0/speed_rpm: 1: expected one of this part's speeds"
check "nothing was written" test ! -e result.json

# Tested cuts.
printf 'depth_mm,speed_rpm,observed\n1,9000,stable\n-1,9000,stable\n' >points.csv
refused 65 '^sdm-lobes: points.csv: line 3: -1: expected a depth' sdm-lobes --cut "$cut" "$table" --points points.csv
printf 'depth_mm,speed_rpm\n1,x\n' >points.csv
refused 65 '^sdm-lobes: points.csv: line 2: "x": expected a speed' sdm-lobes --cut "$cut" "$table" --points points.csv
printf 'depth_mm,speed_rpm,observed\n1,9000,maybe\n' >points.csv
refused 65 '^sdm-lobes: points.csv: line 2: "maybe": expected stable or chatter' sdm-lobes --cut "$cut" "$table" --points points.csv

# Usage.
refused 64 '^sdm-lobes: --teeth: missing: expected --cut' sdm-lobes "$table"
refused 64 '^sdm-lobes: --kr: missing' sdm-lobes "$table" --teeth 2 --kt 600
refused 64 '^sdm-lobes: -: expected standard input for one input only' sdm-lobes --cut - <"$cut"
refused 64 '^sdm-lobes: --speed: 5000:20000: expected FROM:TO:COUNT' sdm-lobes "$table" --cut "$cut" --speed 5000:20000
refused 64 '^sdm-lobes: --depth: -1: expected depths from 0' sdm-lobes "$table" --cut "$cut" --depth -1:2:3
refused 64 '^sdm-lobes: --speed: 1:2:2000000000: expected .* COUNT at most 10000000' sdm-lobes "$table" --cut "$cut" --speed 1:2:2000000000
refused 64 '^sdm-lobes: --speed, --depth: 20000000: expected at most 10000000 points of the chart .*--shard' \
  sdm-lobes "$table" --cut "$cut" --speed 5000:9000:2000 --depth 0:1:10000
refused 64 '^sdm-lobes: --speed, --samples: 2001000: expected at most 1000000 speeds' \
  sdm-lobes "$table" --cut "$cut" --speed 5000:9000:1000 --samples 2000
refused 64 '^sdm-lobes: --speed, --intervals: 192000000000: expected at most 100000000000' \
  sdm-lobes "$table" --cut "$cut" --speed 5000:9000:3 --method sdm --intervals 4000
refused 64 '^sdm-lobes: --speed: 0: expected speeds above 0' sdm-lobes "$table" --cut "$cut" --speed 0:2:3
refused 64 '^sdm-lobes: --teeth: 0: expected' sdm-lobes "$table" --teeth 0 --kt 1 --kr 1 --milling up --immersion 1
refused 64 '^sdm-lobes: --kt: nan: expected' sdm-lobes "$table" --teeth 1 --kt nan --kr 1 --milling up --immersion 1
refused 64 '^sdm-lobes: --modes: 16: expected at most 15' sdm-lobes "$table" --cut "$cut" --modes 16
refused 64 '^sdm-lobes: --modes: 3-1: expected' sdm-lobes "$table" --cut "$cut" --modes 3-1
refused 64 '^sdm-lobes: --intervals: expected with --method sdm' sdm-lobes "$table" --cut "$cut" --intervals 20
refused 64 '^sdm-lobes: .*--method' sdm-lobes "$table" --cut "$cut" --method magic

refused 64 "^sdm-lobes: --points: empty: expected a value" sdm-lobes "$table" --cut "$cut" --points ''
refused 64 '^sdm-lobes: options: /teeth: 100000: expected' sdm-lobes "$table" --teeth 100000 --kt 1 --kr 1 --milling up --immersion 1
refused 1 'the fastest mode turns too often' sdm-lobes "$table" --cut "$cut" --speed 1e-3:1e-3:1
printf '[%.0s' {1..1000} >deep.json
refused 65 '^sdm-lobes: deep.json: .*nested too deeply' sdm-lobes --cut "$cut" deep.json

# Outputs.
point=(sdm-lobes "$table" --cut "$cut" --speed 9000:9000:1 --depth 1:1:1)
refused 74 '^sdm-lobes: /dev/full: cannot be written: No space left' "${point[@]}" -o /dev/full
"${point[@]}" >/dev/full 2>.err
check "/dev/full as standard output is an I/O error" test $? -eq 74
refused 73 '^sdm-lobes: none/result.json: cannot be created' "${point[@]}" -o none/result.json
mkdir folder
refused 73 '^sdm-lobes: folder: cannot be created' "${point[@]}" -o folder
echo before >kept.json
refused 65 '^sdm-lobes: table.json' sdm-lobes --cut "$cut" table.json -o kept.json
check "an old output survives a failure" test "$(cat kept.json)" = before
check "no temporary file is left" test -z "$(find . -name '.stablecut-*')"
if [ "$(id -u)" -ne 0 ]; then
  touch secret.json; chmod 000 secret.json
  refused 66 '^sdm-lobes: secret.json: cannot be read' sdm-lobes --cut "$cut" secret.json
fi

jq '.corner_radius_mm = 7' "$data/thesis-cut.json" >corner.json
refused 65 '^sdm-lobes: corner.json: /corner_radius_mm: 7: expected at most half of diameter_mm$' sdm-lobes "$table" --cut corner.json
jq '.entry_deg = 0 | .exit_deg = 90' "$data/thesis-cut.json" >twice.json
refused 65 '^sdm-lobes: twice.json: /radial_immersion: 0.25: expected either radial_immersion with milling or entry_deg' sdm-lobes "$table" --cut twice.json
sdm-lobes "$table" --cut "$data/thesis-cut.json" --speed 9000:12000:2 --depth 0:4:3 --method sdm --intervals 8 2>said >rough.json
check "few intervals are said to be too few" grep -Eq '^sdm-lobes: warning: the semi-discretization is off by up to 0\.[0-9]* of max\(1, radius\) \(see /convergence\): more --intervals$' said
