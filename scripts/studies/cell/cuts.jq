# Each place's best cut, and that of all, at every place. Input: lobes of each place and of all, then the points at each place.
def digits($d): . as $x | ($x | fabs | log10 | floor) as $e | pow(10; $d - 1 - $e) as $f | ($x * $f | round) / $f;
($places | split(" ")) as $names | ($names | length) as $n | . as $all
| "| best cut of | depth, mm | speed, rpm | removal, cm3/min | \($names | map("radius, \(.)") | join(" | ")) |", "|---|---:|---:|---:|\("---:|" * $n)",
  (range($n + 1) as $i | $all[$i].what_to_run.best[0] as $best
   | "| \($names[$i] // "**all three**") | \($best.depth_mm | digits(3)) | \($best.speed_rpm | round) | \($best.removal_cm3_per_min | digits(3)) | "
     + ([range($n) as $j | $all[$n + 1 + $j].points[$i] | (.spectral_radius * 1e5 | round / 1e5 | tostring) + (if .stable then "" else " **chatter**" end)] | join(" | ")) + " |")
