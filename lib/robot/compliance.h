// The compliance of the tool point from the joints' (Yi et al., eqs. 8, 9, 14).
#pragma once

#include <optional>

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

/// What a pose is judged by.
enum class StiffnessIndex {
  kCombined,    ///< sqrt(Kx^2 + Ky^2 + Kz^2) along the tool's axes, N/m, largest (eq. 15, corrected)
  kWeakest,     ///< least principal stiffness, N/m, largest
  kAxial,       ///< stiffness along the tool axis, N/m, largest
  kDeflection,  ///< |C_tt F|, m, least
};

struct StiffnessTask {
  StiffnessIndex index = StiffnessIndex::kCombined;
  std::optional<Eigen::Vector3d> force_n;  ///< needed for kDeflection
  bool force_in_tool = false;              ///< the force is given in the tool's frame, else in the base's

  bool larger_is_better() const { return index != StiffnessIndex::kDeflection; }
  /// True when turning the robot about joint 6 cannot change the score, for a tool coaxial with it.
  bool blind_to_tool_turn() const {
    if (index == StiffnessIndex::kDeflection && force_in_tool) return force_n && force_n->head<2>().isZero(0);
    return index != StiffnessIndex::kCombined;
  }
};

/// The force in the base frame, for a tool of that orientation.
Eigen::Vector3d force_in_base(const StiffnessTask& task, const Eigen::Matrix3d& tool_rotation);

/// The score by the task's index: N/m, or m for kDeflection.
double stiffness_score(const Eigen::Matrix3d& compliance, const Eigen::Matrix3d& tool_rotation,
                       const StiffnessTask& task);

}  // namespace stablecut::robot
