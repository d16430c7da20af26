# Our numbers, by the names of paper.tsv.
def mean: add / length;
def largest($field): [.[0][$field][][] | select(. != null)] | max;
def radii: .[0] as $m | [range($m.y_mm | length) as $j | range($m.x_mm | length) as $i | select($m.score[$j][$i] != null) | ($m.x_mm[$i] * $m.x_mm[$i] + $m.y_mm[$j] * $m.y_mm[$j] | sqrt)];
def radius: .[0].best.tcp_mm | (.[0] * .[0] + .[1] * .[1]) | sqrt;
{
  x_least: $ranges[0].x[0], x_most: $ranges[0].x[1], z_least: $ranges[0].z[0], z_most: $ranges[0].z[1],
  workspace_x: $workspace[0].x, workspace_low: $workspace[0].z[0], workspace_high: $workspace[0].z[1],
  reach: $reach[0], ring_outer: ($map_1600 | radii | max), ring_inner: ($pose_1600 | radius),
  z_table_2: ([$table_2[0].evaluated[].tcp_mm[2]] | mean), z_table_3: ([$table_3[0].evaluated[].tcp_mm[2]] | mean),
  three_d_over_two_d: ([[$table_2_3d[0].evaluated[], $table_3_3d[0].evaluated[] | .deflection_um], [$table_2[0].evaluated[], $table_3[0].evaluated[] | .deflection_um]]
    | transpose | map(.[0] / .[1]) | max),
  best_1600: $pose_1600[0].best.score, best_1200: $pose_1200[0].best.score,
  ky_0: ($turned_0 | largest("stiffness_y_n_per_m")), ky_30: ($turned_30 | largest("stiffness_y_n_per_m")), ky_60: ($turned_60 | largest("stiffness_y_n_per_m")),
  kz_0: (($turned_0 | largest("stiffness_z_n_per_m")) / 1e3),
  kz_gain: ([[$turned_0, $turned_30 | [.[0].stiffness_z_n_per_m[][] | . // 0]] | transpose[] | (.[1] - .[0]) / 1e3 * 1e6 | round / 1e6] | max_by(fabs))
} + ([range(6) | {key: "high_\(. + 1)", value: $table_2[0].evaluated[.].deflection_um}, {key: "low_\(. + 1)", value: $table_3[0].evaluated[.].deflection_um}] | from_entries)
| to_entries[] | "\(.key)\t\(.value)"
