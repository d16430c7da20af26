# Table 6-2 beside the fit, in the table's own normalisation: psi_R may be multiplied by any complex c where psi_L is divided by it.
# c is chosen so that psi_R lies nearest to the table's.
def times($a; $b): [$a[0] * $b[0] - $a[1] * $b[1], $a[0] * $b[1] + $a[1] * $b[0]];
def conjugate: [.[0], -.[1]];
def over($a; $b): ($b[0] * $b[0] + $b[1] * $b[1]) as $n | times($a; $b | conjugate) | map(. / $n);
def size: [flatten[] | . * .] | add | sqrt;
def digits($d): . as $x | if $x == 0 then 0 else ($x | fabs | log10 | floor) as $e | pow(10; $d - 1 - $e) as $f | ($x * $f | round) / $f end;
def shown: map(. * 1e4 | digits(4)) | "\(.[0])" + (if .[1] < 0 then "-" else "+" end) + "\(.[1] | fabs)i";
def away($a; $b): ([range($a | length) | [$a[.][0] - $b[.][0], $a[.][1] - $b[.][1]]] | size) / ($b | size) * 100 | digits(2);
"| mode | f, Hz: table | here | damping, %: table | here | psi_R x; y, 1e-4 sqrt(s/kg): table | here | off, % | psi_L x; y: table | here | off, % |",
"|---:|---:|---:|---:|---:|---|---|---:|---|---|---:|",
(. as $table | range($table.modes | length) as $k | $table.modes[$k] as $t | $fit[0].modes[$k] as $m
 | over(reduce range(2) as $i ([0, 0]; . as $s | times($m.psi_r[$i] | conjugate; $t.psi_r[$i]) | [.[0] + $s[0], .[1] + $s[1]]);
        [($m.psi_r | size) | . * ., 0]) as $c
 | [$m.psi_r[] | times(.; $c)] as $r | [$m.psi_l[] | over(.; $c)] as $l
 | "| \($k + 1) | \($t.frequency_hz) | \($m.frequency_hz | digits(6)) | \($t.damping_ratio * 100 | digits(4)) | \($m.damping_ratio * 100 | digits(4)) | "
   + "\($t.psi_r | map(shown) | join("; ")) | \($r | map(shown) | join("; ")) | \(away($r; $t.psi_r)) | "
   + "\($t.psi_l | map(shown) | join("; ")) | \($l | map(shown) | join("; ")) | \(away($l; $t.psi_l)) |")
