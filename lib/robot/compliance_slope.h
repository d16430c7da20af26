// How what follows from C_tt changes with the springs' compliances, and how far it is off for that.
// README.md, "Uncertainty of a score".
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <vector>

#include "robot/joint_stiffness.h"

namespace stablecut::robot {

inline constexpr double kGradientStep = 1e-5;  // of C_tt

/// d value(C) / d c_k by central differences; C is linear in the compliances. A spring that does not move the
/// tool point has none.
template <typename Value>
Eigen::VectorXd compliance_gradient(const RobotPose& pose, const std::vector<Spring>& springs,
                                    const Eigen::Matrix3d& compliance, const Value& value) {
  Eigen::VectorXd result = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(springs.size()));
  for (std::size_t k = 0; k < springs.size(); ++k) {
    const Eigen::Vector3d v = spring_axis(pose, springs[k]).displacement(pose.tool.translation());
    const double size = v.squaredNorm();
    if (!(size > 0)) continue;
    const double step = kGradientStep * compliance.norm();  // of what c_k adds to C along v
    const Eigen::Matrix3d change = step / size * v * v.transpose();
    result[k] = size * (value(compliance + change) - value(compliance - change)) / (2 * step);
  }
  return result;
}

/// The variance that the compliances' covariance gives to what has this gradient; 0 without one.
inline double propagated(const Eigen::VectorXd& gradient, const ElasticityErrors& errors) {
  return errors.covariance ? std::max(0.0, gradient.dot(*errors.covariance * gradient)) : 0;
}

}  // namespace stablecut::robot
