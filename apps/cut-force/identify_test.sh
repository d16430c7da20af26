#!/usr/bin/env bash
# cut-force --identify: coefficients from forces, and what the forces cannot tell.
. "$SOURCE/apps/testing.sh"
tool=$data/slotting-tool.json forces=$data/slot-forces.csv

cut-force --identify "$forces" "$tool" -o found.json 2>said
check "nothing to say of good forces" test ! -s said
# Behind the forces: Kt 700, Kr 250, Ka 150 N/mm2, edges 20, 30, 4 N/mm, noise 2 N.
check_jq "within their intervals" found.json '[.identification.coefficients[].interval_95] as $i | [700, 250, 20, 30, 150, 4] | to_entries
  | all(.value >= $i[.key][0] and .value <= $i[.key][1])'
check_jq "the residual is the noise" found.json '.identification.in_plane.residual_rms_n | . > 1.5 and . < 2.5'
check_jq "the rest of the cut is kept" found.json '.teeth == 2 and .feed_per_tooth_mm == 0.05 and .diameter_mm == 12'
check_jq "deviations are the covariance's" found.json '(.kt_std_n_per_mm2 * .kt_std_n_per_mm2 / .identification.covariance[0][0] - 1 | fabs) < 1e-12'
sdm-lobes "$data/thesis-table-6-2.json" --cut - --speed 9000:12000:3 --depth 0:2:5 --samples 20 <found.json -o lobes.json 2>said
check_jq "sdm-lobes takes it, and draws from its deviations" lobes.json '[.limit[] | .interval_95_mm | .[1] - .[0]] | any(. > 0.05)'
check "without a warning that there are none" test ! -s said
jq 'del(.kt_n_per_mm2, .kr_n_per_mm2)' "$tool" | cut-force --identify "$forces" -o unknown.json
check "what is sought need not be in the cut" cmp <(jq '.kt_n_per_mm2, .kr_n_per_mm2, .identification' found.json) <(jq '.kt_n_per_mm2, .kr_n_per_mm2, .identification' unknown.json)
cut-force found.json -o force.json
check_jq "and so does cut-force" force.json '.mean_force_n[1] > 10'

jq '.kt_kr_correlation = 0.9 | .kt_std_n_per_mm2 = 100 | .kr_std_n_per_mm2 = 100' found.json >together.json
jq '.kt_kr_correlation = -0.9' together.json >against.json
for cut in together against; do
  sdm-lobes "$data/thesis-table-6-2.json" --cut $cut.json --speed 9000:12000:3 --depth 0:2:5 --samples 40 --limit-only -o $cut-out.json
done
check "the correlation changes the intervals" test "$(jq -c .limit together-out.json)" != "$(jq -c .limit against-out.json)"

awk -F, 'BEGIN {OFS = ","} NR > 1 {$1 = -$1; $2 = -$2; $3 = -$3} {print}' "$forces" >workpiece.csv
cut-force --identify workpiece.csv --force-on workpiece "$tool" -o other.json
check_jq "forces on the workpiece" other.json '[.kt_n_per_mm2 / $f[0].kt_n_per_mm2, .kae_n_per_mm / $f[0].kae_n_per_mm] | all(. - 1 | fabs < 1e-4)' --slurpfile f found.json
refused 1 '^cut-force: Kt = -694.* are these the forces on the workpiece\? \(--force-on workpiece\)' cut-force --identify workpiece.csv "$tool"
awk -F, 'BEGIN {OFS = ","} NR > 1 {$2 = -$2} {print}' "$forces" >mirrored.csv
refused 1 'expected numbers above 0: is fx_n along the feed' cut-force --identify mirrored.csv "$tool"

awk -F, 'NR == 1 || $4 == 0.03' "$forces" >one.csv
refused 1 '^cut-force: Kt cannot be told from its edge force.*--edges cut' cut-force --identify one.csv "$tool"
jq '.kte_n_per_mm = 20 | .kre_n_per_mm = 30 | .kae_n_per_mm = 4' "$tool" >edges.json
cut-force --identify one.csv --edges cut edges.json -o held.json
check_jq "edges of the cut" held.json '(.kt_n_per_mm2 - 700 | fabs) < 200 and .kte_n_per_mm == 20 and (has("kte_std_n_per_mm") | not)
  and .identification.coefficients[2].verdict == "held"'
cut -d, -f1,2,4- "$forces" >plane.csv
cut-force --identify plane.csv "$tool" -o plane.json
check_jq "no axial forces, no axial coefficients" plane.json '(has("ka_n_per_mm2") | not) and .identification.coefficients[4].verdict == "unmeasured"'
cut -d, -f3- "$forces" >axial.csv
refused 1 '^cut-force: Kt cannot be found: expected forces fx_n and fy_n' cut-force --identify axial.csv "$tool"
head -n 3 "$forces" >two.csv
cut-force --identify two.csv "$tool" -o two.json 2>said
check "as many forces as coefficients is said" grep -q 'no standard deviations' said
check_jq "and there are none" two.json '(has("kt_std_n_per_mm2") | not) and .identification.covariance[0][0] == null'

# A size effect, scatter by axis, deviations that are too small, an edge force below 0.
awk -F, 'BEGIN {OFS = ","} NR > 1 {s = $4 / 0.05; $1 *= s; $2 *= s} {print}' "$forces" >bent.csv
cut-force --identify bent.csv "$tool" 2>said >bent.json
check "forces that bend are said" grep -q 'not linear in the feed' said
awk -F, 'BEGIN {OFS = ","} {print $0, NR == 1 ? "fx_std_n" : 0.1, NR == 1 ? "fy_std_n" : 0.1}' "$forces" >stated.csv
cut-force --identify stated.csv "$tool" 2>said >stated.json
check "stated deviations that are too small are said" grep -q 'scaled up' said
check_jq "and written" stated.json '.identification.in_plane.deviations_contradicted'
awk -F, 'BEGIN {OFS = ","} NR > 1 {$3 -= 9 * $5} {print}' "$forces" >below.csv
cut-force --identify below.csv "$tool" 2>said >below.json
check "a coefficient below 0 is held at 0, and said" grep -q 'Kae = .*held at 0' said
check_jq "in the document too" below.json '.kae_n_per_mm == 0 and .identification.coefficients[5].held_at_zero'

# Engagement of each cut, and records.
cat >cuts.csv <<'END'
fx_n;fy_n;feed_per_tooth_mm;depth_mm;milling;radial_immersion
END
for way in up down; do for width in 0.3 0.6; do for feed in 0.05 0.1 0.15; do
  jq --arg way $way --argjson width $width --argjson feed $feed '.milling = $way | .radial_immersion = $width | .feed_per_tooth_mm = $feed
    | .kt_n_per_mm2 = 700 | .kr_n_per_mm2 = 250 | .kte_n_per_mm = 20 | .kre_n_per_mm = 30' "$tool" >cut.json
  cut-force cut.json --depth 2 | jq -r --arg way $way --argjson width $width --argjson feed $feed '[.mean_force_n[0], .mean_force_n[1], $feed, 2, $way, $width] | map(tostring) | join(";")' >>cuts.csv
done; done; done
cut-force --identify cuts.csv "$tool" -o cuts-out.json
check_jq "up and down milling of any width" cuts-out.json '[.kt_n_per_mm2 - 700, .kr_n_per_mm2 - 250, .kte_n_per_mm - 20, .kre_n_per_mm - 30] | all(fabs < 1e-9)'
mkdir records
echo 'record,feed_per_tooth_mm,depth_mm,speed_rpm' >records/list.csv
for feed in 0.05 0.1 0.15; do
  jq --argjson feed $feed '.feed_per_tooth_mm = $feed | .kt_n_per_mm2 = 700 | .kr_n_per_mm2 = 250 | .kte_n_per_mm = 20 | .kre_n_per_mm = 30' "$tool" >cut.json
  # 3.3 revolutions of 360 steps at 3000 rpm: the mean is that of three.
  cut-force cut.json --depth 2 | jq -r '"time_s,fx_n,fy_n", (.wave as $w | range(1188) | "\(. / 18000),\($w.feed_n[. % 360]),\($w.normal_n[. % 360])")' >records/$feed.csv
  echo "$feed.csv,$feed,2,3000" >>records/list.csv
done
cut-force --identify records/list.csv "$tool" -o records-out.json
check_jq "means of records" records-out.json '[.kt_n_per_mm2 / 700, .kr_n_per_mm2 / 250, .kte_n_per_mm / 20, .kre_n_per_mm / 30] | all(. - 1 | fabs < 0.03)'
check_jq "records are inputs" records-out.json '.provenance.inputs | length == 5'

# Too few forces: what reaches 0 is named, with its interval.
head -n 4 "$forces" >few.csv
cut-force --identify few.csv "$tool" -o few.json 2>said
check "coefficients whose interval reaches 0 are named" test "$(grep -o 'K[a-z]* = [^,:]* +- ' said | cut -d' ' -f1 | paste -sd,)" = \
  "$(jq -r '[.identification.coefficients[] | select(.interval_95[0] <= 0) | .name] | map({kt_n_per_mm2: "Kt", kr_n_per_mm2: "Kr", kae_n_per_mm: "Kae", ka_n_per_mm2: "Ka", kte_n_per_mm: "Kte", kre_n_per_mm: "Kre"}[.] // .) | join(",")' few.json)"
check "in one line" test "$(grep -c 'the interval reaches 0$' said)" -eq 1

# The arc as columns of the table, in the place of the cut's.
awk -F, 'BEGIN {OFS = ","} {print $0, NR == 1 ? "entry_deg" : 0, NR == 1 ? "exit_deg" : 180}' "$forces" >arc.csv
jq '.milling = "up" | .radial_immersion = 0.25' "$tool" | cut-force --identify arc.csv -o arc.json
check_jq "a slot by its angles" arc.json '(.kt_n_per_mm2 / $f[0].kt_n_per_mm2 - 1 | fabs) < 1e-9 and (.kr_n_per_mm2 / $f[0].kr_n_per_mm2 - 1 | fabs) < 1e-9' --slurpfile f found.json
