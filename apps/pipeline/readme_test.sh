#!/usr/bin/env bash
# Runs the README's examples: the code blocks that follow a line <!-- tested -->, in a folder with testdata and scripts; and those of
# stablecut(7), which has to name every kind of document with the fields that it must have, every tool and every script.
. "$SOURCE/apps/testing.sh"
ln -s "$SOURCE/testdata" "$SOURCE/scripts" .
awk '/^<!-- tested -->$/ {wanted = 1; next} /^```/ {if (inside) inside = 0; else if (wanted) {inside = 1; wanted = 0}; next}
     inside' "$SOURCE/README.md" >examples.sh
check "the README has examples" test -s examples.sh
bash -euo pipefail examples.sh >log 2>&1; status=$?
check "the README examples run: $(tail -n 2 log)" test $status -eq 0

# The commands of each manual page, in this folder, with a table and a cut of the reader's own.
cp testdata/thesis-table-6-2.json modes.json
cp testdata/thesis-cut.json cut.json
/usr/bin/python3 "$SOURCE/apps/fit-modes/simulate_taps.py" . && mv x.csv hits-x.csv
for page in "$SOURCE"/apps/*/*.1 "$SOURCE/apps/stablecut.7"; do
  awk '/^\.SH/ {examples = /EXAMPLES/} /^\.fi/ {inside = 0} inside && examples; /^\.nf/ {inside = 1}' "$page" | sed 's/\\-/-/g' |
    grep -vE '^(limit|print|chart|radius|grid|contour|stable)\b' >page.sh
  check "$(basename "$page") has examples" test "$(wc -l <page.sh)" -ge 3
  PATH=$PWD/scripts:$PATH bash -euo pipefail page.sh >log 2>&1; status=$?
  check "the examples of $(basename "$page") run: $(tail -n 2 log)" test $status -eq 0
done
page=$SOURCE/apps/stablecut.7
sed 's/\\-/-/g; s/\\f[BIPR]//g' "$page" >page.txt
for schema in "$SOURCE"/schemas/*.schema.json; do
  kind=$(basename "$schema" .schema.json)
  entry=$(awk -v kind="$kind" '$0 == ".I " kind && before == ".TP" {inside = 1} /^\.(TP|PP|SH)/ {inside = 0} inside; {before = $0}' page.txt)
  check "stablecut(7): $kind: what writes or reads it" grep -qE 'Yours|[Ww]ritten by' <<<"$entry"
  for field in $(jq -r '.required - ["format"] | .[]' "$schema"); do
    check "stablecut(7): $kind: $field" grep -qw -- "$field" <<<"$entry"
  done
done
for name in $(cd "$SOURCE/apps" && ls */*.1); do check "stablecut(7): $name" grep -q "^\.BR $(basename "$name" .1) (1)" page.txt; done
for name in $(cd "$SOURCE/scripts" && echo plot-*) stablecut-report import-urdf; do check "stablecut(7): $name" grep -q -- "$name" page.txt; done
