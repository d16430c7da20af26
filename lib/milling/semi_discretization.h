// The zeroth-order semi-discretization of [RobotMillingThesis, eqs. 6-29 to 6-39], after [Insperger2004], on
// the smallest state that keeps its eigenvalues. README.md, "Semi-discretization".
#pragma once

#include <Eigen/Core>

#include "milling/cutter.h"
#include "milling/floquet.h"

namespace stablecut::milling {

/// Only the tip's displacement is delayed, and with w_a = w_b = 1/2 only the mean of its values at the two
/// ends of an interval: the state is the modal state and that mean for each interval in cut. The textbook
/// matrix of m + 1 full states has the same nonzero eigenvalues.
class SemiDiscretizationMap : public PeriodMap {
 public:
  /// For straight teeth of equal pitch, without process damping. `intervals` is m >= 1; the first begins when
  /// tooth 1 is at +Y. The structure must outlive the map.
  SemiDiscretizationMap(const TipStructure& structure, const Cutter& cutter, double revolutions_per_s,
                        int intervals);

  /// [2 modes + directions * intervals in cut, square]. The means of A over the intervals are exact
  /// integrals, an interval's map is a matrix exponential, and motion without a force is exact.
  Eigen::MatrixXd monodromy(double depth_m) const override;
  std::vector<ForceImpulse> forces(double depth_m, std::complex<double> multiplier,
                                   const Eigen::VectorXcd& state) const override;

 private:
  double interval_s_;
  Eigen::Index intervals_in_cut_ = 0;
  std::vector<Eigen::MatrixXd> mean_coefficient_;  // per interval; empty where nothing cuts
};

}  // namespace stablecut::milling
