// The joints' stiffness as far as it is known.
#pragma once

#include <array>
#include <optional>

#include "robot/kinematics.h"

namespace stablecut::robot {

struct JointStiffness {
  std::array<std::optional<double>, kJoints> stiffness;  ///< N m/rad
  /// Of the compliances, (rad/(N m))^2, with zero rows where nothing is known; absent when no standard
  /// deviation is known.
  std::optional<Matrix6d> compliance_covariance;
};

}  // namespace stablecut::robot
