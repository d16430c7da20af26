#!/usr/bin/env bash
# Bad input to fit-modes: the right exit status, one line that names the place, nothing half-written.
. "$SOURCE/apps/testing.sh"
fit-modes --synthesize 1:100:100 --noise-db 40 "$data/thesis-table-6-2.json" -o good.json

# frf_with FILTER PLACE: the measurement changed by a jq filter is refused with that place and status 65.
frf_with() {
  jq "$1" good.json >tap.json
  refused 65 "^fit-modes: tap.json: $2" fit-modes tap.json -o result.json --fitted fitted.json
}
frf_with '.h[0].re[17] = "x"' '/h/0/re/17: "x": expected a finite number'
frf_with '.h[0].im[17] = null' '/h/0/im/17: null: expected a finite number'
frf_with '.h[1].re |= .[1:]' '/h/1/re: a list of 99: expected 100 numbers'
frf_with '.h[2].variance |= .[1:]' '/h/2/variance: a list of 99: expected 100 numbers'
frf_with '.h[2].variance[5] = -1' '/h/2/variance/5: -1: expected'
frf_with 'del(.h[3].im)' '/h/3/im: missing'
frf_with 'del(.h)' '/h: missing'
frf_with '.h = []' '/h: a list of 0: expected'
frf_with '.frequency_hz[4] = 1' '/frequency_hz/4: 1: expected increasing'
frf_with '.frequency_hz[0] = -1' '/frequency_hz/0: -1: expected'
frf_with '.frequency_hz = []' '/frequency_hz: a list of 0: expected'
frf_with '.quantity = "dynamic stiffness"' '/quantity: "dynamic stiffness": expected "receptance" or'
frf_with 'del(.quantity)' '/quantity: missing'
frf_with '.h[1].reference = "x"' '/h/1: xx: expected each pair of directions once'
frf_with '.h[1].refrence = "x"' '/h/1/refrence: unknown field: expected reference'
frf_with '.frequency_rad = []' '/frequency_rad: unknown field: expected frequency_hz'
frf_with '.h[0].coherence = .frequency_hz' '/h/0/coherence/1: .*expected a coherence from 0 to 1'
frf_with '.h[0].coherence = [range(100) | 0.9]' '/h/0/averages: missing'
frf_with '.format = "stablecut/lobes/1"' '/format: "stablecut/lobes/1": expected "stablecut/frf/1"'
frf_with 'del(.format)' '/format: missing'
check "nothing was written" test ! -e result.json -a ! -e fitted.json

refused 65 '^fit-modes: <stdin>: empty input' fit-modes </dev/null
head -c 3000 good.json >truncated.json
refused 65 '^fit-modes: truncated.json: line [0-9]+: /' fit-modes truncated.json
printf '1,2,3\n2,oops,3\n' >bad.csv
refused 65 '^fit-modes: bad.csv: line 2: "oops": expected a real part in column 2' fit-modes bad.csv
refused 65 '^fit-modes: good.json: expected at least 8 lines' fit-modes --band 1:3 good.json
refused 65 '^fit-modes: good.json: no lines in the band' fit-modes --band 1000:3000 good.json
jq '.h |= map(.re |= map(0) | .im |= map(0))' good.json >zeros.json
refused 1 '^fit-modes: zeros.json: all entries are zero' fit-modes zeros.json

# A table's covariance, as synthesize (and every other reader) meets it.
fit-modes --quiet good.json --modes 2 -o table.json
table_with() {
  jq "$1" table.json >wrong.json
  refused 65 "^fit-modes: wrong.json: $2" fit-modes --synthesize 1:2:2 wrong.json
}
table_with '.fit.covariance.parameters[3] = "/modes/9/frequency_hz"' '/fit/covariance/parameters/3: "/modes/9/frequency_hz": expected the pointer'
table_with '.fit.covariance.parameters[3] = .fit.covariance.parameters[2]' '/fit/covariance/parameters/3: .*each once'
table_with '.fit.covariance.matrix |= .[1:]' '/fit/covariance/matrix: a list of 19: expected 20 rows'
table_with '.fit.covariance.matrix[4] |= .[1:]' '/fit/covariance/matrix/4: .*expected 20 numbers'
table_with '.fit.covariance.matrix[4][4] = -1' '/fit/covariance/matrix/4: .*expected a variance that is not negative'
table_with '.fit.covariance.matrix[4][5] = 1' '/fit/covariance/matrix: .*expected a symmetric matrix'
table_with 'del(.fit.covariance.matrix)' '/fit/covariance/matrix: missing'

refused 64 '^fit-modes: --band: 5: expected LO:HI' fit-modes --band 5 good.json
refused 64 '^fit-modes: --delay: late: expected milliseconds' fit-modes --delay late good.json
refused 64 '^fit-modes: --delay: =1: expected milliseconds' fit-modes --delay =1 good.json
refused 64 '^fit-modes: --scale: xy=0: expected a factor' fit-modes --scale xy=0 good.json
refused 64 '^fit-modes: --scale: zz=2: expected an entry of good.json' fit-modes --scale zz=2 good.json
refused 64 '^fit-modes: --modes: many: expected auto or a number' fit-modes --modes many good.json
refused 64 '^fit-modes: --modes: 0: expected' fit-modes --modes 0 good.json
refused 64 '^fit-modes: --synthesize: 12000000: expected at most 10000000 values' \
  fit-modes --synthesize 1:2:3000000 "$data/thesis-table-6-2.json"
refused 64 '^fit-modes: --seed: expected with --synthesize' fit-modes --seed 3 good.json
refused 64 '^fit-modes: --fitted: expected without --synthesize' fit-modes --synthesize 1:2:2 --fitted x "$data/thesis-table-6-2.json"
refused 64 '^fit-modes: --synthesize: 1:2: expected FROM:TO:COUNT' fit-modes --synthesize 1:2
refused 64 '^fit-modes: --quantity: mobility: expected receptance' fit-modes --quantity mobility good.json
refused 64 '^fit-modes: same.json: expected another output' fit-modes --quiet good.json --modes 3 -o same.json --fitted same.json
refused 74 '^fit-modes: /dev/full: cannot be written' fit-modes --quiet good.json --modes 3 -o kept.json --fitted /dev/full
check "one failed output leaves none" test ! -e kept.json -a -z "$(find . -name '.stablecut-*')"
