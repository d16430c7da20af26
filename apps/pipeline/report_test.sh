#!/usr/bin/env bash
# scripts/report: one page of documents of any kinds, that asks for nothing and runs nothing of theirs.
. "$SOURCE/apps/testing.sh"
report=$SOURCE/scripts/report
/usr/bin/python3 -c 'import jsonschema, markdown' 2>/dev/null && [ -f /usr/share/javascript/chart.js/chart.min.js ] ||
  { echo "skipped: python3-jsonschema, python3-markdown or libjs-chart.js is not installed (scripts/setup)"; trap - EXIT; exit 77; }
sdm-lobes "$data/thesis-table-6-2.json" --cut "$data/thesis-cut.json" --points "$data/thesis-table-6-3.csv" --speed 5000:20000:12 --depth 0:4:9 \
  --per-mode --quiet -o lobes.json
fit-modes --quiet --synthesize 2:1000:800 --noise-db 40 "$data/thesis-table-6-2.json" -o tap.json
fit-modes --quiet tap.json --fitted fitted.json --stabilization stabilization.json -o modes.json
robot=$data/kr360.json
joint-stiffness --quiet --robot "$robot" "$data/kr360-loads.csv" -o stiffness.json
best-pose --quiet --robot "$robot" --height 1600 --x=-2600:2600:14 --y=-2600:2600:14 --map map.json stiffness.json -o pose.json
best-pose --quiet --robot "$robot" --path "$data/zigzag-path.json" --force 200,400,-150 --force-frame feed stiffness.json -o path.json
rcsa-couple --quiet --identify "$data/carbide-tap.json" "$data/carbide-in-collet.json" -o joint.json
jq '.feed_per_tooth_mm = 0.1' "$data/thesis-cut.json" >fed.json
cut-force fed.json --depth 2 --speed 9000 --quiet -o force.json
documents=(lobes.json tap.json fitted.json stabilization.json modes.json stiffness.json map.json pose.json path.json joint.json force.json fed.json
  "$robot" "$data/liu-assembly.json" "$data/zigzag-path.json")
"$report" "${documents[@]}" -o all.html 2>.err
check "a page of all kinds" test $? -eq 0 -a -s all.html -a ! -s .err
check "the same documents, the same bytes" cmp -s all.html <("$report" "${documents[@]}")
check "nothing is asked of a network" test "$(grep -oE '(src|href)="[^"]{0,8}' all.html | grep -vc 'src="data:')" -eq 0
check "the library's licence" grep -q 'Permission is hereby granted' all.html
/usr/bin/python3 - all.html >charts.json <<'PYTHON'
import html, json, re, sys
page = open(sys.argv[1]).read()
data = json.loads(re.search(r'<script type="application/json" id="charts">(.*?)</script>', page, re.S).group(1))
charts = [chart | {"curves": [curve | {"x": data["abscissas"][curve["x"]]} for curve in chart["curves"]]} for chart in data["charts"]]
headings = [html.unescape(text) for text in re.findall("<h2>(.*?)</h2>", page)]
json.dump({"charts": charts, "headings": headings, "canvases": len(re.findall("<canvas ", page))}, sys.stdout)
PYTHON
check_jq "a section for each kind, responses over each other" charts.json '[.headings[] | split(":")[0]] == ["Stability", "Frequency responses",
  "Stabilization", "Modes", "Joint stiffness", "Pose map", "Poses", "Path", "Tool joint", "Cutting force", "cut", "robot", "assembly", "tool-path", "Provenance"]'
check_jq "a canvas for each chart" charts.json '.canvases == (.charts | length) and .canvases > 15'
check_jq "every radius of the chart, to five digits" charts.json '.charts[0].cells.rows as $shown
  | [range($lobes[0].depth_mm | length) as $i | range($lobes[0].speed_rpm | length) as $j
     | (($shown[$i][$j] - $lobes[0].spectral_radius[$i][$j]) / $lobes[0].spectral_radius[$i][$j] | fabs)] | length == 108 and max < 5.1e-5' --slurpfile lobes lobes.json
check_jq "the chatter frequency of each column" charts.json '[.charts[0].cells.hover[] | select(.[0] | startswith("chatter frequency")) | .[1]][0]
  | map(. != null) == [$lobes[0].limit[] | .chatter_frequency_hz != null]' --slurpfile lobes lobes.json
check_jq "axes with units" charts.json 'all(.charts[]; all(.x.label, .y.label; test("pole pairs|, ")))'
check_jq "the fit over the measurement" charts.json '[.charts[] | select(.title == "H xx, magnitude") | .curves[].name] == ["tap", "fitted"]'
check "the tree of what came from what" grep -q 'fit-modes .*thesis-table-6-2.json' all.html
check "and where it stands in the page" grep -q 'in this page: tap.json' all.html
check "an interval of a joint" grep -q '95 % from' all.html
echo '{"format": "stablecut/joint-stiffness/1", "stiffness_n_m_per_rad": [7e6, 4e6, 3e6, 2e6, 1e6, 6e5]}' | "$report" - -o bare.html
check "no column for what is not known" test "$(grep -c '95 % from' bare.html)" -eq 0 -a "$(grep -c '<th>stiffness</th>' bare.html)" -eq 1

# 200 x 100 points, the size of a study's chart.
sdm-lobes "$data/thesis-table-6-2.json" --cut "$data/thesis-cut.json" --quiet | "$report" - -o large.html
check "a chart of 200 x 100 in less than 2 MB" test "$(wc -c <large.html)" -lt 2000000

# Texts of a document or a name are text.
evil='</script><script>window.pwned=1;document.title="pwned"</script><img src=x onerror="window.pwned=1"><svg onload=window.pwned=1>'
jq --arg evil "$evil" '.label = $evil' path.json >evil-path.json
jq --arg evil "$evil" '.provenance.arguments = [$evil] | .provenance.tool = $evil | .provenance.inputs[0].name = $evil' lobes.json >evil-lobes.json
jq --arg evil "$evil" '.best.name = $evil' pose.json >evil-pose.json
jq --arg evil "$evil" '.name = $evil | .joints[0].name = $evil' "$robot" >evil-robot.json
cp map.json '<img src=x onerror=alert(1)>.json'
printf '# A title\n\n%s\n\n<b onclick="window.pwned=1">bold</b> [link](javascript:window.pwned=1)\n\n| a | b |\n|---|---:|\n| 1 | 2 |\n' "$evil" >evil.md
"$report" --title "$evil" --text evil.md evil-path.json evil-lobes.json evil-pose.json evil-robot.json '<img src=x onerror=alert(1)>.json' -o evil.html
check "hostile labels make a page" test -s evil.html
check "three scripts, of which one is data" test "$(grep -o '<script' evil.html | wc -l)" -eq 3
check "no element of a label" test "$(grep -ciE '<(img|svg|b)[ >]' evil.html)" -eq "$(grep -ciE '<b>' evil.html)"
check "no link but to the web" test "$(grep -o '<a href="[^"]*"' evil.html | grep -vcE '"(https?://|#)')" -eq 0
check "scripts are named by their sums" grep -q "script-src &#39;sha256-" evil.html

# Text with pictures.
scripts=$SOURCE/scripts
"$scripts/plot-lobes" lobes.json -o lobes.svg
printf '# Words\n\n![limits](lobes.svg)\n' >words.md
"$report" --text words.md lobes.json -o words.html
check "a picture is packed in" grep -q 'src="data:image/svg+xml;base64,' words.html
printf '![none](missing.svg)\n' >missing.md
refused 66 '^report: missing.md: missing.svg: cannot be read' "$report" --text missing.md lobes.json
printf '![remote](https://example.org/a.js)\n' >remote.md
refused 65 '^report: remote.md: https://example.org/a.js: expected a picture' "$report" --text remote.md lobes.json

refused 64 '^report: expected documents' "$report"
refused 64 '^report: --nonsense: unknown option' "$report" --nonsense
refused 64 '^report: -o: expected a value' "$report" lobes.json -o
refused 64 '^report: -: expected standard input once' "$report" - - </dev/null
refused 65 '^report: <stdin>: empty input: expected a JSON document$' "$report" - </dev/null
refused 66 '^report: missing.json: cannot be read' "$report" missing.json
refused 73 '^report: none/x.html: cannot be created' "$report" lobes.json -o none/x.html
echo '{"format": "stablecut/nonsense/1"}' >kind.json
refused 65 '^report: kind.json: /format: stablecut/nonsense/1: expected' "$report" kind.json
jq '.depth_mm[1] = "x"' lobes.json >bad.json
refused 65 '^report: bad.json: /depth_mm/1: ' "$report" lobes.json bad.json
sed 's/"convergence": *[0-9.e+-]*/"convergence": NaN/' lobes.json >nan.json
refused 65 '^report: nan.json: not JSON: NaN: expected a finite number' "$report" nan.json
sed 's/"method"/"method": "sdm", "method"/' lobes.json >twice.json
refused 65 '^report: twice.json: not JSON: a key stands twice' "$report" twice.json
jq '.spectral_radius[2] |= .[1:]' lobes.json >short.json
refused 65 '^report: short.json: /spectral_radius/2: 11 values: expected 12' "$report" short.json
jq '.h[0].im |= .[1:]' tap.json >short.json
refused 65 '^report: short.json: /h/0/im: 799 values: expected 800' "$report" short.json
jq '.score |= .[1:]' map.json >short.json
refused 65 '^report: short.json: /score: 13 values: expected 14' "$report" short.json
sed 's/"convergence": *[0-9.e+-]*/"convergence": 1e999/' lobes.json >large.json
refused 65 '^report: large.json: not JSON: 1e999: expected a finite number' "$report" large.json
jq '.label = "HALF"' path.json | sed 's/HALF/\\ud800/' >half.json
"$report" half.json -o half.html; check "half a character in a label" test -s half.html
{ printf '['; head -c 20000 /dev/zero | tr '\0' '['; } >deep.json
refused 65 '^report: deep.json: not JSON' "$report" deep.json
jq '.speed_rpm[3] += 300' lobes.json >uneven.json
"$report" uneven.json -o uneven.html; check "an uneven grid is said, not drawn" grep -q 'not evenly spaced' uneven.html
# No mode has a limit, and few columns.
sdm-lobes "$data/thesis-table-6-2.json" --cut "$data/thesis-cut.json" --speed 9000:12000:3 --depth 0:0.2:3 --modes 1 --per-mode --quiet -o stable.json
"$report" stable.json -o stable.html; check "stable everywhere is said" grep -q 'Stable over the whole chart' stable.html
check "--help" "$report" --help >/dev/null
"$report" large.html 2>/dev/null; check "nothing written where something is wrong" test ! -e x.html

# In a browser, where there is one.
"$scripts/test-report" all.html evil.html large.html stable.html uneven.html >browser 2>.err
status=$?
if [ $status -eq 77 ]; then echo "skipped: the browser: $(cat .err)"
else
  check "no word on the console, every chart drawn and told: $(head -n 3 .err)" test $status -eq 0
  check "the pointer reads speed, depth, spectral radius and chatter frequency" grep -qE \
    'Stability lobes.*spindle speed, rpm: [0-9.]+ \| axial depth, mm: [0-9.]+ \| spectral radius: [0-9.]+ \| limit at this speed, mm: [0-9.]+ \| chatter frequency there, Hz: [0-9.]+' browser
fi
