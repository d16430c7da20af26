// The compliance of the tool point from the joints' (Yi et al., eqs. 8, 9, 14).
#pragma once

#include <Eigen/Core>

#include "robot/kinematics.h"

namespace stablecut::robot {

/// C_tt = J_v diag(c) J_v^T, m/N, base frame: the displacement of the tool point under a force there, with
/// the links rigid and `joint_compliance` c in rad/(N m). Not the top-left block of (J^-T K_theta J^-1)^-1,
/// which locks the rotations.
Eigen::Matrix3d translational_compliance(const RobotPose& pose, const JointAngles& joint_compliance);

/// Eigenvalues of C_tt, largest first, m/N: the principal stiffnesses are their inverses.
Eigen::Vector3d principal_compliances(const Eigen::Matrix3d& compliance);

/// Force over the length of the displacement, N/m, for a force along the unit vector u: 1 / |C_tt u| (eq.
/// 14).
inline double directional_stiffness(const Eigen::Matrix3d& compliance, const Eigen::Vector3d& u) {
  return 1 / (compliance * u).norm();
}

}  // namespace stablecut::robot
