#!/usr/bin/env bash
# The plot scripts: pictures of the right form, refusals like the tools'.
. "$SOURCE/apps/testing.sh"
scripts=$SOURCE/scripts
sdm-lobes "$data/thesis-table-6-2.json" --cut "$data/thesis-cut.json" --points "$data/thesis-table-6-3.csv" \
  --speed 5000:20000:12 --depth 0:4:9 -o lobes.json
fit-modes --synthesize 2:1000:200 "$data/thesis-table-6-2.json" -o frf.json
for plot in lobes frf; do
  for form in svg png; do
    "$scripts/plot-$plot" $plot.json -o $plot.$form 2>.err
    check "plot-$plot to $form" test $? -eq 0 -a -s $plot.$form -a ! -s .err
  done
  check "plot-$plot: SVG" grep -q '</svg>' $plot.svg
  check "plot-$plot: PNG" test "$(head -c 4 $plot.png | tail -c 3)" = PNG
  "$scripts/plot-$plot" --terminal <$plot.json >text
  check "plot-$plot in a terminal" grep -q 'o\|\.' text
  refused 64 "^plot-$plot: --nonsense: unknown option" "$scripts/plot-$plot" --nonsense
  refused 64 "^plot-$plot: x.pdf: expected a name that ends in .svg or .png" "$scripts/plot-$plot" $plot.json -o x.pdf
  refused 66 "^plot-$plot: missing.json: cannot be read" "$scripts/plot-$plot" missing.json -o x.svg
  check "plot-$plot --help" "$scripts/plot-$plot" --help >/dev/null
done
refused 65 '^plot-lobes: frf.json: /format: stablecut/frf/1: expected stablecut/lobes/1' "$scripts/plot-lobes" frf.json -o x.svg
"$scripts/plot-frf" frf.json --fitted frf.json --parts complex -o both.svg
check "measured and fitted, real and imaginary" grep -q 'Im H' both.svg
sdm-lobes "$data/thesis-table-6-2.json" --cut "$data/thesis-cut.json" --speed 9000:9000:1 --depth 0.1:0.1:1 --limit-only |
  "$scripts/plot-lobes" -o stable.svg
check "a chart without a limit says so" grep -q 'stable over the whole chart' stable.svg
