// What a measured deflection at a new pose is off by, beside what the compliances' covariance says.
// README.md, "Discrepancy".
#pragma once

#include <cmath>

#include "robot/left_out.h"

namespace stablecut::robot {

/// The standard deviation of a deflection of length d about its prediction is the root of (relative d)^2 +
/// absolute_m^2, added to what the covariance gives.
struct Discrepancy {
  double relative = 0;
  double absolute_m = 0;
  double force_n = 0;  ///< root mean square of the loads that absolute_m belongs to

  bool none() const { return relative == 0 && absolute_m == 0; }
  double variance(double length_m) const {
    return std::pow(relative * length_m, 2) + absolute_m * absolute_m;
  }
  /// Of a stiffness along one direction, as a share of it, where a unit force yields by `compliance` m/N: the
  /// loads' deflection is what it is a share of.
  double relative_variance(double compliance) const {
    return relative * relative + std::pow(absolute_m / (compliance * force_n), 2);
  }
};

/// From the lengths of the deflections that the other poses predict: the shares by likelihood, the size so
/// that 95 % of the left-out poses lie within 1.96 deviations; with too few of them for that, by Student's
/// distribution with `freedom` degrees of freedom. `covariance` of the fit's columns.
Discrepancy discrepancy(const ComplianceFit& fit, const LeftOut& by_pose, int poses, double freedom,
                        const Eigen::MatrixXd& covariance, const std::vector<LoadSample>& samples);

}  // namespace stablecut::robot
