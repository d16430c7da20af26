// Slopes of a tapped place: measured, or by finite differences of deflections [Duarte2000]. README.md,
// section 9.
#pragma once

#include <vector>

#include "receptance/beam.h"
#include "receptance/taps.h"

namespace stablecut::receptance {

/// The receptance at the place 0, responses in one direction and loads in one direction, line by line.
struct DirectionBlock {
  std::vector<Receptance<2>> value;  ///< [lines] [[h, l], [n, p]]
  Eigen::VectorXd l_variance;        ///< [lines] of l, the deflection per moment
  double spacing_m = 0;              ///< S of a finite difference; 0: slopes were measured
  bool second_difference = false;    ///< p by a second difference
};

/// The block between direction `d` of the response and `e` of the load (0: x, 1: y), from the entries with
/// slopes, else by a finite difference of the places 0 and S. Throws InvalidArgument where the taps give
/// neither, and for more than two places.
DirectionBlock block_with_slopes(const Taps& taps, int d, int e);

}  // namespace stablecut::receptance
