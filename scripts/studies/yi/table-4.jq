# Table 4 beside the prediction, and how well the orders agree (Spearman).
def ranks: . as $v | map(. as $x | ([$v[] | select(. < $x)] | length) + ([$v[] | select(. == $x)] | length + 1) / 2);
def correlation($a; $b): (($a | add) / ($a | length)) as $ma | (($b | add) / ($b | length)) as $mb
  | ([range($a | length) | ($a[.] - $ma) * ($b[.] - $mb)] | add)
    / (([$a[] | pow(. - $ma; 2)] | add) * ([$b[] | pow(. - $mb; 2)] | add) | sqrt);
. as [$paper, $high, $low]
| [$paper.height_1600_mm, $paper.height_1200_mm | map(.measured_um)] as $measured | [$high, $low | [.evaluated[].deflection_um]] as $predicted
| "| pose | 1.6 m: measured, um | predicted | z of the model, mm | 1.2 m: measured, um | predicted | z of the model, mm |", "|---:|---:|---:|---:|---:|---:|---:|",
  (range(6) as $i | "| \($i + 1) | " + ([range(2) as $t | $measured[$t][$i], ($predicted[$t][$i] | round), ([$high, $low][$t].evaluated[$i].tcp_mm[2] | round)]
     | map(tostring) | join(" | ")) + " |"),
  "| rank correlation | " + ([range(2) as $t | "", (correlation($measured[$t] | ranks; $predicted[$t] | ranks) * 100 | round / 100 | tostring), ""] | join(" | ")) + " |"
