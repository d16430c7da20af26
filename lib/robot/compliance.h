// The compliance of the tool point from the joints' [Yi2025, eqs. 8, 9, 14]. README.md, "Compliance".
#pragma once

#include <Eigen/Core>

#include "robot/joint_stiffness.h"

namespace stablecut::robot {

/// C_tt = J_v diag(c) J_v^T, m/N, base frame [Salisbury1980]: the displacement of the tool point per force
/// there, with rigid links and `joint_compliance` c in rad/(N m).
Eigen::Matrix3d translational_compliance(const RobotPose& pose, const JointAngles& joint_compliance);

/// The same of all springs: the sum of c_k v_k v_k^T, v_k the movement of the tool point per unit of spring
/// k.
Eigen::Matrix3d translational_compliance(const RobotPose& pose, const Elasticity& elasticity);

/// Eigenvalues of C_tt, largest first, m/N: the principal stiffnesses are their inverses.
Eigen::Vector3d principal_compliances(const Eigen::Matrix3d& compliance);

/// Force over the length of the displacement, N/m, for a force along the unit vector u: 1 / |C_tt u|
/// [Yi2025, eq. 14].
inline double directional_stiffness(const Eigen::Matrix3d& compliance, const Eigen::Vector3d& u) {
  return 1 / (compliance * u).norm();
}

}  // namespace stablecut::robot
