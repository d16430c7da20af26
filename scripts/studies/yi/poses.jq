# Tables 2 and 3: the poses, where they stand and how they bend with the joint stiffness of eq. 13 and of eq. 12.
. as [$plane, $space]
| "| pose | A1 | A2 | A3 | A4 | A5 | A6, deg | x | y | z, mm | deflection by eq. 13, um | by eq. 12, um |", "|---:" * 12 + "|",
  (range($plane.evaluated | length) as $i | $plane.evaluated[$i]
   | "| \($i + 1) | " + ([.joints_deg[], (.tcp_mm[] | round), (.deflection_um | round), ($space.evaluated[$i].deflection_um | round)] | map(tostring) | join(" | ")) + " |")
