#!/usr/bin/env bash
# Runs the README's examples: the code blocks that follow a line <!-- tested -->, in a folder with testdata and scripts.
. "$SOURCE/apps/testing.sh"
ln -s "$SOURCE/testdata" "$SOURCE/scripts" .
awk '/^<!-- tested -->$/ {wanted = 1; next} /^```/ {if (inside) inside = 0; else if (wanted) {inside = 1; wanted = 0}; next}
     inside' "$SOURCE/README.md" >examples.sh
check "the README has examples" test -s examples.sh
bash -euo pipefail examples.sh >log 2>&1; status=$?
check "the README examples run: $(tail -n 2 log)" test $status -eq 0
