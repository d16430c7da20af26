# Of charts.tsv (raw lines): for each material the best cut that is stable at all poses, and what a wider margin costs. The margin is how far
# the speed may be off, either way, at a depth 10 % below the least limit within that margin (a natural frequency that is off by a share does
# the same). One pass, a few numbers each chart.
def digits($d): . as $x | if $x == 0 then 0 else ($x | fabs | log10 | floor) as $e | pow(10; $d - 1 - $e) as $f | ($x * $f | round) / $f end;
def margins: [0, 0.005, 0.01, 0.02, 0.03, 0.05];
# Width of cut over diameter: of an arc it is the projection.
def immersion: if .radial_immersion then .radial_immersion else ((.entry_deg | . * 3.141592653589793 / 180 | cos) - (.exit_deg | . * 3.141592653589793 / 180 | cos)) / 2 end;
# Removal rate of a cut, cm3/min: depth, width, feed.
def removal($cut; $speed; $depth): $depth * ($cut | immersion) * $cut.diameter_mm * $cut.teeth * $cut.feed_per_tooth_mm * $speed / 1000;
# The limit at all speeds that are known, those between the chart's too; the chart's top where there is none.
def curve: (.depth_mm | max) as $top | .limit + (.what_to_run.limit_between // []) | sort_by(.speed_rpm)
  | map(select(.not_resolved == null) | [.speed_rpm, (.depth_mm // $top)]);
# The limit at any speed, straight between the known ones.
def at($limit; $speed): first(range(1; $limit | length) | select($limit[.][0] >= $speed)) as $i
  | [$limit[$i - 1], $limit[$i]] as [$a, $b] | if $b[0] == $a[0] then [$a[1], $b[1]] | min else $a[1] + ($b[1] - $a[1]) * ($speed - $a[0]) / ($b[0] - $a[0]) end;
# The best cut with each margin, of one chart.
def best: .cut as $cut | curve as $limit
  | [margins[] as $margin | [$limit[] | . as [$speed, $own]
      | select($speed * (1 - $margin) >= $limit[0][0] and $speed * (1 + $margin) <= $limit[-1][0] or $margin == 0)
      | ([$own, ($limit[] | select(.[0] >= $speed * (1 - $margin) and .[0] <= $speed * (1 + $margin)) | .[1]),
          (if $margin > 0 then at($limit; $speed * (1 - $margin)), at($limit; $speed * (1 + $margin)) else empty end)] | min * 0.9) as $depth
      | {margin: $margin, speed: $speed, depth: $depth, removal: removal($cut; $speed; $depth)}] | max_by(.removal) | select(.)];
reduce (inputs | split("\t")) as [$id, $pose, $tool, $material, $text] ({charts: 0, materials: {}};
  .charts += 1
  | if $pose == "all" then
      ($text | fromjson | best | map(. + {tool: $tool})) as $found
      | .materials[$material] |= ((. // []) + $found | group_by(.margin) | map(max_by(.removal)))
    else . end)
# On the front: no other cut has both more margin and more removal.
| .materials |= map_values(. as $all | map(select(. as $one | all($all[]; .margin <= $one.margin or .removal < $one.removal))))
| "# \(.charts) charts\n",
  "The best cut that is stable at all poses, by margin of speed; 10 % below the least limit within the margin.\n",
  "| material | margin of speed, % | tool | speed, rpm | depth, mm | removal, cm3/min |", "|---|---:|---|---:|---:|---:|",
  (.materials | to_entries[] | .key as $material | .value[]
   | "| \($material) | \(.margin * 100) | \(.tool) | \(.speed | round) | \(.depth | digits(3)) | \(.removal | digits(3)) |")
