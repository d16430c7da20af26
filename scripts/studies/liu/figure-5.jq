include "objective";
def digits($d): . as $x | ($x | fabs | log10 | floor) as $e | pow(10; $d - 1 - $e) as $f | ($x * $f | round) / $f;
.[0] as $beam | ((length - 1) / 2) as $n | . as $all
| "| stiffness | objective, this as k1 (N/m) | objective, this as k2 (N m/rad) |", "|---:|---:|---:|",
  (range($n) as $i | "| 1e\($i + 5) | \($all[1 + $i] | objective($beam) | digits(4)) | \($all[1 + $n + $i] | objective($beam) | digits(4)) |")
