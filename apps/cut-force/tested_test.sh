#!/usr/bin/env bash
# cut-force --tested: Kt and Kr from cuts that were tried, and what contradicts them.
. "$SOURCE/apps/testing.sh"
table=$data/thesis-table-6-2.json
jq '.kt_std_n_per_mm2 = 0.15 * .kt_n_per_mm2 | .kr_std_n_per_mm2 = 0.2 * .kr_n_per_mm2 | .kt_kr_correlation = 0.3' \
  "$data/thesis-cut.json" >prior.json

# A material that is harder by a deviation and a half, tried around the prior's limits: what the chart of the true material says.
jq '.kt_n_per_mm2 *= 1.225 | .kr_n_per_mm2 *= 1.2' prior.json >true.json
sdm-lobes "$table" --cut prior.json --speed 6000:16000:6 --depth 0:5:2 --limit-only -o limits.json
jq -r '"depth_mm,speed_rpm", (.limit[] | select(.depth_mm) | . as $l | (0.75, 0.9, 1.05) | "\(. * $l.depth_mm),\($l.speed_rpm)")' limits.json >cuts.csv
sdm-lobes "$table" --cut true.json --points cuts.csv --limit-only -o judged.json
jq -r '"depth_mm,speed_rpm,observed", (.points[] | "\(.depth_mm),\(.speed_rpm),\(if .stable then "stable" else "chatter" end)")' judged.json >tested.csv
check "there are cuts of both kinds" test "$(grep -c stable tested.csv)" -gt 3 -a "$(grep -c chatter tested.csv)" -gt 3

cut-force prior.json --table "$table" --tested tested.csv --samples 600 --quiet -o learnt.json 2>said
check "nothing to say" test ! -s said
check_jq "the interval covers the true value, and is narrower than the prior" learnt.json '.posterior.kt_interval_95_n_per_mm2 as $i
  | $t[0].kt_n_per_mm2 > $i[0] and $t[0].kt_n_per_mm2 < $i[1] and .kt_std_n_per_mm2 < 0.8 * $t[0].kt_std_n_per_mm2' --slurpfile t true.json
check_jq "nearer to the true value" learnt.json '(.kt_n_per_mm2 - $t[0].kt_n_per_mm2 | fabs) < 0.5 * ($t[0].kt_n_per_mm2 - $p[0].kt_n_per_mm2)' \
  --slurpfile t true.json --slurpfile p prior.json
check_jq "the prior, the cuts and how sure it is stand beside it" learnt.json '.posterior.prior.kt_n_per_mm2 == $p[0].kt_n_per_mm2
  and (.posterior.cuts | length) == ($j[0].points | length) and .posterior.effective_samples > 100 and .posterior.as_unlikely_share > 0.001
  and all(.posterior.cuts[]; .stable_probability >= 0 and .stable_probability <= 1)' --slurpfile p prior.json --slurpfile j judged.json
check_jq "the rest of the cut is kept" learnt.json '.teeth == $p[0].teeth and .radial_immersion == $p[0].radial_immersion' --slurpfile p prior.json
cut-force prior.json --table "$table" --tested tested.csv --samples 600 --quiet --threads 1 -o again.json
check "the same bytes on one thread" cmp learnt.json again.json
sdm-lobes "$table" --cut - --speed 9000:12000:3 --depth 0:2:5 --samples 20 <learnt.json -o lobes.json 2>said
check_jq "sdm-lobes draws from it" lobes.json '[.limit[].interval_95_mm | select(.[0] and .[1]) | .[1] - .[0]] | any(. > 0)'
jq '[.points[] | {depth_mm, speed_rpm, observed: (if .stable then "stable" else "chatter" end)}]' judged.json >tested.json
cut-force prior.json --table "$table" --tested tested.json --samples 600 --quiet --no-provenance -o as-json.json
check "JSON says the same" cmp <(jq -S 'del(.provenance)' learnt.json) <(jq -S . as-json.json)
cut-force learnt.json --table "$table" --tested tested.csv --samples 200 --quiet -o twice.json 2>/dev/null
check_jq "what was learnt is a prior" twice.json '.posterior.prior.kt_n_per_mm2 == $l[0].kt_n_per_mm2' --slurpfile l learnt.json

# What should chatter is stable, and the other way round.
awk -F, 'BEGIN {OFS = ","} NR > 1 {$3 = ($3 == "stable") ? "chatter" : "stable"} {print}' tested.csv >against.csv
refused 1 '^cut-force: the tested cuts contradict .*--wrong-share' cut-force prior.json --table "$table" --tested against.csv --samples 600
cut-force prior.json --table "$table" --tested tested.csv --samples 20 -o few.json 2>said
check "few samples are said" grep -q 'effective samples: more are needed (--samples)' said

refused 64 '^cut-force: --tested: expected with --table' cut-force prior.json --tested tested.csv
refused 64 '^cut-force: --tested: expected without --depth' cut-force prior.json --table "$table" --tested tested.csv --depth 1
refused 64 '^cut-force: --tested: expected without --identify' cut-force prior.json --table "$table" --tested tested.csv --identify "$data/slot-forces.csv"
refused 64 '^cut-force: --samples, --seed, --wrong-share: expected with --tested' cut-force prior.json --samples 10
refused 64 '^cut-force: --wrong-share: 0.5: expected a ratio above 0 and below 0.5' cut-force prior.json --table "$table" --tested tested.csv --wrong-share 0.5
refused 65 '^cut-force: .*thesis-cut.json: /kt_std_n_per_mm2: expected a standard deviation' cut-force "$data/thesis-cut.json" --table "$table" --tested tested.csv
refused 65 '^cut-force: cuts.csv: expected cuts that were observed' cut-force prior.json --table "$table" --tested cuts.csv
sed 's/chatter/unstable/' tested.csv >word.csv
refused 65 '^cut-force: word.csv: line [0-9]*: "unstable": expected stable or chatter' cut-force prior.json --table "$table" --tested word.csv
