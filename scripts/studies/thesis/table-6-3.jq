# Table 6-3 with the outcomes: the thesis's method, converged, and converged with Table 6-2 transposed.
def radius: (. * 1e5 | round / 1e5 | tostring);
. as [$sdm, $converged, $transposed]
| "| depth, mm | speed, rpm | observed | radius, 40 intervals | radius, converged | radius, table transposed |",
  "|---:|---:|---|---:|---:|---:|",
  (range($sdm.points | length) as $i | [$sdm, $converged, $transposed | .points[$i]] as $p
   | "| \($p[0].depth_mm) | \($p[0].speed_rpm) | \($p[0].observed) | " + ([$p[] | (.spectral_radius | radius) + (if .agrees then "" else " **missed**" end)] | join(" | ")) + " |")
