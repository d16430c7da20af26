#include "robot/singularity_lanes.h"

#include "numerics/elementary_lanes.h"

namespace stablecut::robot {
namespace {

using Four = numerics::FourLanes;

STABLECUT_INLINE Four load(const double* from) { return numerics::load_lanes<Four>(from); }

// One column of the Jacobian: the point's velocity about the axis through `at`, and the axis.
STABLECUT_INLINE void column(const Four axis[3], const Four arm[3], Four out[6]) {
  out[0] = axis[1] * arm[2] - axis[2] * arm[1];
  out[1] = axis[2] * arm[0] - axis[0] * arm[2];
  out[2] = axis[0] * arm[1] - axis[1] * arm[0];
  for (int d = 0; d < 3; ++d) out[3 + d] = axis[d];
}

}  // namespace

// Singular values do not feel the signs of the columns.
STABLECUT_WIDE void arms_away_from_singularities(const ArmLanes& lanes, const double point[3], double margin,
                                                 bool away[kArms]) {
  const Four zero = {}, one = zero + 1;
  Four j[6][6], axis[3], to_point[3];
  const auto arm_from = [&](const double at[3][kArms]) STABLECUT_INLINE_LAMBDA {
    for (int d = 0; d < 3; ++d) to_point[d] = point[d] - load(at[d]);
  };
  const auto axis_of = [&](const double of[3][kArms]) STABLECUT_INLINE_LAMBDA {
    for (int d = 0; d < 3; ++d) axis[d] = load(of[d]);
  };
  for (int d = 0; d < 3; ++d) axis[d] = d == 2 ? one : zero, to_point[d] = zero + point[d];
  column(axis, to_point, j[0]);
  axis_of(lanes.axis2), arm_from(lanes.point2), column(axis, to_point, j[1]);
  arm_from(lanes.point3), column(axis, to_point, j[2]);
  for (int d = 0; d < 3; ++d) to_point[d] = zero + (point[d] - lanes.wrist[d]);
  axis_of(lanes.axis4), column(axis, to_point, j[3]);
  axis_of(lanes.axis5), column(axis, to_point, j[4]);
  for (int d = 0; d < 3; ++d) axis[d] = zero + lanes.axis6[d];
  column(axis, to_point, j[5]);
  // The pivots of J J^T - margin^2 are all above 0 where it is positive definite; their least is kept, and a
  // pivot that is not above 0 is replaced, so that the lanes run on.
  Four m[6][6], least = one;
  for (int r = 0; r < 6; ++r) {
    for (int c = 0; c <= r; ++c) {
      Four sum = zero;
      for (int k = 0; k < 6; ++k) sum += j[k][r] * j[k][c];
      m[r][c] = r == c ? sum - margin * margin : sum;
    }
  }
  for (int p = 0; p < 6; ++p) {
    const Four pivot = m[p][p];
    least = numerics::least(least, pivot);
    const Four per_pivot = 1 / (pivot > 0 ? pivot : one);
    for (int r = p + 1; r < 6; ++r) {
      const Four factor = m[r][p] * per_pivot;
      for (int c = p + 1; c <= r; ++c) m[r][c] -= factor * m[c][p];
    }
  }
  for (int a = 0; a < kArms; ++a) away[a] = least[a] > 0;
}

}  // namespace stablecut::robot
