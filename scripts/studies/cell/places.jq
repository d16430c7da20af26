# One row a place. Input: poses, the modes of each place, the lobes of each place.
def digits($d): . as $x | ($x | fabs | log10 | floor) as $e | pow(10; $d - 1 - $e) as $f | ($x * $f | round) / $f;
($places | split(" ")) as $names | ($names | length) as $n | . as $all
| "| place | x, y, z, mm | weakest stiffness, N/um | modes | lowest modes, Hz | stable at every speed, mm | best cut there | removal, cm3/min |",
  "|---|---|---:|---:|---|---:|---|---:|",
  (range($n) as $i | $all[1 + $i] as $modes | $all[1 + $n + $i] as $lobes | $all[0].evaluated[$i] as $pose | $lobes.what_to_run.best[0] as $best
   | "| \($pose.name) | \($pose.tcp_mm | map(round | tostring) | join(", ")) | \($pose.principal_stiffness_n_per_m | min / 1e6 | digits(3)) | "
     + "\($modes.modes | length) | \($modes.modes[:5] | map(.frequency_hz | digits(4) | tostring) | join(", ")) | "
     + "\($lobes.what_to_run.unconditional.depth_mm | digits(3)) | \($best.depth_mm | digits(3)) mm at \($best.speed_rpm | round) rpm | \($best.removal_cm3_per_min | digits(3)) |")
