#!/usr/bin/env bash
# The studies: one of them from its Makefile to its page, and the table that sets a paper's numbers beside ours.
. "$SOURCE/apps/testing.sh"
studies=$SOURCE/scripts/studies
/usr/bin/python3 -c 'import jsonschema, markdown' 2>/dev/null && [ -f /usr/share/javascript/chart.js/chart.min.js ] && command -v make >/dev/null ||
  { echo "skipped: make, python3-jsonschema, python3-markdown or libjs-chart.js is not installed (scripts/setup)"; trap - EXIT; exit 77; }

# Where a number that can agree does not, or one that cannot does, the page is not made.
row() { printf 'name\tquantity\twhere\tpaper\twithin\twhy\n%s\tits | name\tTable 1\t%s\t%s\tits reason\n' "$1" "$2" "$3" >paper.tsv; }
says() { printf '%s\t%s\n' "$1" "$2" >ours.tsv; }
row a 100 2%; says a 101.5
"$studies/beside" paper.tsv ours.tsv >table.md; check "a number within its share" test $? -eq 0
check "is set beside the paper's" grep -qF '| its \| name | Table 1 | 100 | 101.5 | +1.5 (+1.5 %) | agrees within 2% | its reason |' table.md
says a 103; refused 1 '^beside: a: 103: expected 100 within 2%' "$studies/beside" paper.tsv ours.tsv
row a 100 3; says a 103; check "within a distance" "$studies/beside" paper.tsv ours.tsv >table.md
says a 96.9; refused 1 '^beside: a: 96.9: expected 100 within 3' "$studies/beside" paper.tsv ours.tsv
row a 100 ''; says a 150; check "what cannot agree" "$studies/beside" paper.tsv ours.tsv >table.md
says a 100.5; refused 1 'though the row says that it cannot be' "$studies/beside" paper.tsv ours.tsv
row a '1, 2' 0; says a '1, 2'; check "words" "$studies/beside" paper.tsv ours.tsv >table.md
says a '1, 3'; refused 1 '^beside: a: 1, 3: expected 1, 2' "$studies/beside" paper.tsv ours.tsv
says b 1; refused 1 '^beside: a: no number of ours' "$studies/beside" paper.tsv ours.tsv
row a 1 0; printf 'a\t1\nb\t2\n' >ours.tsv; refused 1 "^beside: b: not among the paper's numbers" "$studies/beside" paper.tsv ours.tsv

for study in thesis yi liu cell; do
  check "$study: what would be made" make -C "$studies/$study" OUT="$PWD/out" TOOLS=/nonexistent -n report >/dev/null 2>&1
done
# As installed: a folder that is no checkout; the results come to where make is called.
mkdir -p share
cp -r "$SOURCE/scripts" "$SOURCE/schemas" "$SOURCE/testdata" share
make -C share/scripts/studies/liu TOOLS=/nonexistent report >.log 2>&1
check "Liu et al.: a page: $(tail -n 3 .log)" test $? -eq 0 -a -s out/studies/liu/report.html
check "with its pictures" test "$(grep -o 'src="data:image/png;base64,' out/studies/liu/report.html | wc -l)" -eq 5
check "and its numbers" grep -q '<td align="right">97062227</td>' out/studies/liu/report.html
check "what is there is not made again" make -C share/scripts/studies/liu TOOLS=/nonexistent -q "$PWD/out/studies/liu/report.html"
make -C "$studies/liu" TOOLS=/nonexistent -n -B report >.log
check "in a checkout they stand in its out" grep -qx "mkdir -p $SOURCE/out/studies/liu" .log
check "all four at once" test "$(make -C share/scripts/studies OUT="$PWD/other" TOOLS=/nonexistent -n report | grep -c "mkdir -p $PWD/other/")" -eq 4
