// The force of whole edges over a turn: at each angle, its harmonics and its peak. README.md, "The force of a
// cut".
#pragma once

#include <Eigen/Core>
#include <complex>

#include "milling/cutting_force.h"

namespace stablecut::milling {

/// The force at one depth; a helical edge is straight ones one after the other.
class EdgeForce {
 public:
  EdgeForce(const Cutter& cutter, const CuttingLoad& load, double depth_m);

  double period_rad() const { return cycle_.period_rad; }
  /// N, at a turn; where a straight tooth enters or leaves, after it.
  ForceParts at(double turn_rad) const;
  ForceParts mean() const { return depth_m_ * cycle_.mean(); }
  /// Coefficient of exp(i order 2 pi turn / period) in the force's Fourier series.
  Eigen::Matrix<std::complex<double>, 4, 1> harmonic(int order) const;

  struct Peak {
    double turn_rad = 0, force_n = 0, along_n = 0;  ///< the largest length; the largest sum along the cut
  };
  Peak peak() const;

 private:
  ForceCycle cycle_;
  double depth_m_, lag_rad_;  // at the top of the edge
};

}  // namespace stablecut::milling
