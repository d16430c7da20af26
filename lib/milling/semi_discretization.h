// The thesis's zeroth-order semi-discretization (6-29) to (6-39), on the smallest state that keeps its
// eigenvalues: the modal state, and the mean delayed displacement over each interval in cut.
#pragma once

#include <Eigen/Core>

#include "milling/cutter.h"
#include "milling/floquet.h"

namespace stablecut::milling {

/// Only the tip displacement is delayed, and with w_a = w_b = 1/2 only the mean of its values at an
/// interval's two ends; the textbook matrix of (m + 1) full states has the same nonzero eigenvalues.
class SemiDiscretizationMap : public PeriodMap {
 public:
  /// For straight teeth of equal pitch, without process damping. `intervals` is m >= 1, from phase 0 on
  /// (tooth 1 at +Y). The structure must outlive the map.
  SemiDiscretizationMap(const TipStructure& structure, const Cutter& cutter, double revolutions_per_s,
                        int intervals);

  /// [2 modes + directions * intervals in cut, square]. The averages (6-29) are exact integrals; each
  /// interval's map is a matrix exponential, free flight is exact.
  Eigen::MatrixXd monodromy(double depth_m) const override;
  std::vector<ForceImpulse> forces(double depth_m, std::complex<double> multiplier,
                                   const Eigen::VectorXcd& state) const override;

 private:
  double interval_s_;
  Eigen::Index intervals_in_cut_ = 0;
  std::vector<Eigen::MatrixXd> mean_coefficient_;  // per interval; empty where nothing cuts
};

}  // namespace stablecut::milling
