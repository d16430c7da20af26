# Our numbers, by the names of paper.tsv.
include "objective";
def apart($other): [.h[0], $other.h[0]] as [$a, $b] | [range($a.re | length)
  | (pow($a.re[.] - $b.re[.]; 2) + pow($a.im[.] - $b.im[.]; 2) | sqrt) / (pow($b.re[.]; 2) + pow($b.im[.]; 2) | sqrt)] | max;
{
  stub: ($stub[0] | peak(1; 5000)),
  bar: ($bar[0] | peak(3000; 5000)),
  cantilever: ($rigid[0] | apart($one_cantilever[0])),
  objective: ($paper_joint[0] | objective($one_cantilever[0])),
  least_objective: $joint[0].objective.value_m_per_n,
  k1: $joint[0].k1_n_per_m, c1: $joint[0].c1_n_s_per_m, k2: $joint[0].k2_n_m_per_rad, c2: $joint[0].c2_n_m_s_per_rad
} | to_entries[] | "\(.key)\t\(.value)"
