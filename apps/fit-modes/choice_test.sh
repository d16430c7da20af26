#!/usr/bin/env bash
# fit-modes with something known: lines to leave out, poles to begin with or to keep.
. "$SOURCE/apps/testing.sh"
table=$data/thesis-table-6-2.json
fit-modes --synthesize 2:1000:3993 --noise-db 40 "$table" -o tap.json
fit-modes tap.json -o modes.json --quiet

# Lines that something ruined, left out.
jq '.frequency_hz as $f | .h |= map(.re |= [range(length) as $i | if $f[$i] >= 295 and $f[$i] <= 305 then 30 * .[$i] else .[$i] end])' tap.json >ruined.json
fit-modes ruined.json --exclude 294:306,990:1200 --exclude 0:3 -o excluded.json --fitted fitted.json 2>log
check_jq "the bands and the lines that are left are in the document" excluded.json '.fit.excluded_hz == [[294, 306], [990, 1200], [0, 3]] and .fit.lines == $n' \
  --argjson n "$(jq '[.frequency_hz[] | select((. >= 294 and . <= 306 or . >= 990 or . <= 3) | not)] | length' tap.json)"
check_jq "the modes are those of the sound tap" excluded.json '[.modes, $whole[0].modes] | transpose | length == 15 and all(
  (.[0].frequency_hz - .[1].frequency_hz | fabs) < 3 * .[1].std.frequency_hz)' --slurpfile whole modes.json
check_jq "--fitted has all lines" fitted.json '.frequency_hz == $tap[0].frequency_hz' --slurpfile tap tap.json
refused 65 '^fit-modes: tap.json: no lines left: expected some outside --exclude' fit-modes --quiet tap.json --exclude 0:2000
refused 64 '^fit-modes: --exclude: 5: expected LO:HI' fit-modes tap.json --exclude 3:4,5
refused 64 '^fit-modes: --exclude: expected without --synthesize' fit-modes --synthesize 1:2:2 --exclude 1:2 "$table"

# Poles of a table: kept, or as starts; as columns.
fit-modes tap.json --poles "$table" --poles-are fixed -o fixed.json
check_jq "fixed poles stay, without a deviation" fixed.json '.fit.poles == "fixed" and ([.modes, $truth[0].modes] | transpose | length == 15 and all(
  (.[0].frequency_hz / .[1].frequency_hz - 1 | fabs) < 1e-12 and (.[0].damping_ratio / .[1].damping_ratio - 1 | fabs) < 1e-10
  and .[0].std.frequency_hz == 0 and .[0].std.damping_ratio == 0 and (.[0].std.psi_r | flatten | all(. > 0))))' --slurpfile truth "$table"
check_jq "noise is all that is left" fixed.json '.fit.stopped_by == "noise" and .fit.reduced_chi_square > 0.97 and .fit.reduced_chi_square < 1.02'
check_jq "the poles' file is an input" fixed.json '[.provenance.inputs[].name | split("/")[-1]] == ["tap.json", "thesis-table-6-2.json"] and .provenance.arguments == ["--poles-are", "fixed"]'
jq -r '"damping_ratio,frequency_hz", (.modes[] | [.damping_ratio * 1.05, .frequency_hz * 1.0002] | @csv)' "$table" >poles.csv
fit-modes tap.json --poles poles.csv -o started.json
check_jq "columns, as starts: the modes that the search finds" started.json '.fit.poles == "starts" and ([.modes, $whole[0].modes] | transpose | length == 15 and all(
  (.[0].frequency_hz - .[1].frequency_hz | fabs) < 0.1 * .[1].std.frequency_hz))' --slurpfile whole modes.json
sdm-lobes fixed.json --cut "$data/thesis-cut.json" --speed 9000:12000:3 --depth 0:1:3 --samples 3 --quiet -o lobes.json
check_jq "sdm-lobes takes such a table, and draws from it" lobes.json '.limit | length == 3'
refused 64 '^fit-modes: --modes: expected without --poles' fit-modes tap.json --poles poles.csv --modes 3
refused 64 '^fit-modes: --poles-are: expected only with --poles' fit-modes tap.json --poles-are fixed
refused 64 '^fit-modes: --poles-are: good: expected' fit-modes tap.json --poles poles.csv --poles-are good
refused 66 '^fit-modes: none.csv: cannot be read' fit-modes tap.json --poles none.csv
printf 'frequency_hz,damping_ratio\n100,2\n' >bad.csv
refused 65 '^fit-modes: bad.csv: line 2: 2: expected a damping ratio above 0 and below 1' fit-modes tap.json --poles bad.csv
printf 'frequency_hz,damping_ratio\n100,0.02\n100,0.02\n' >twice.csv
refused 65 '^fit-modes: twice.csv: line 3: 100 Hz: expected each pole once' fit-modes tap.json --poles twice.csv

# What lies outside the band as residual terms; where modes in the band limit, a chart is that of the whole table.
fit-modes "$table" --synthesize 10:1000:1981 --noise-db 50 -o band.json
fit-modes band.json --band 30:1000 --poles "$table" --residuals -o residuals.json --quiet
check_jq "two terms below and two above the band, at fixed poles" residuals.json '.fit.residuals == true and .fit.poles == "starts"
  and ([.modes[] | select(.out_of_band)] | length == 4 and all(.std.frequency_hz == 0)) and ([.modes[] | select(.out_of_band | not)] | length == 12)'
for modes in "$table" residuals.json; do
  sdm-lobes "$modes" --cut "$data/thesis-cut.json" --speed 11000:12000:3 --depth 0:3:3 --quiet -o "$(basename "$modes" .json).lobes.json"
done
check_jq "a chart of such a table" residuals.lobes.json '[.limit, $whole[0].limit] | transpose
  | length == 3 and all((.[0].depth_mm / .[1].depth_mm - 1 | fabs) < 0.01)' --slurpfile whole "$(basename "$table" .json).lobes.json"

# Only xx and yy were tapped: poles of their own, or one where they agree.
jq '.modes |= [.[:3][] | .frequency_hz as $f | .damping_ratio as $z | (.psi_r[0] as $r | .psi_l[0] as $l | {frequency_hz: $f, damping_ratio: $z, psi_r: [$r, [0, 0]], psi_l: [$l, [0, 0]]}),
  (.psi_r[1] as $r | .psi_l[1] as $l | {frequency_hz: $f, damping_ratio: $z, psi_r: [[0, 0], $r], psi_l: [[0, 0], $l]})]' "$table" >apart.json
fit-modes --synthesize 2:200:1500 --noise-db 40 apart.json | jq '.h |= map(select(.response == .reference))' >diagonal.json
fit-modes diagonal.json -o own.json --quiet
fit-modes diagonal.json --shared-poles -o shared.json --quiet
check_jq "poles of their own" own.json '(.modes | length) == 6 and ([.modes[].frequency_hz] | unique | length) == 6 and (.fit | has("shared_poles") | not)'
check_jq "shared where they agree, and surer" shared.json '.fit.shared_poles as $n | $n >= 2 and ([.modes[].frequency_hz] | unique | length) == 6 - $n
  and ([.modes, $own[0].modes] | transpose | all(.[0].std.frequency_hz <= .[1].std.frequency_hz * (1 + 1e-9)))' --slurpfile own own.json
refused 64 '^fit-modes: --shared-poles: expected without --poles-are fixed' fit-modes diagonal.json --shared-poles --poles poles.csv --poles-are fixed
