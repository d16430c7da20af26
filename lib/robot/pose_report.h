// All that is said of one pose. README.md, "Uncertainty of a score".
#pragma once

#include <Eigen/Core>
#include <optional>

#include "robot/cut_deflection.h"
#include "robot/joint_stiffness.h"
#include "robot/stiffness_index.h"

namespace stablecut::robot {

struct PoseReport {
  JointAngles angles;
  Eigen::Isometry3d tool;     ///< base frame, m
  double redundancy_rad = 0;  ///< about the tool's own axis
  /// SI units; NaN where the arm cannot yield in a direction that the index takes into account.
  double score = 0;
  Eigen::Matrix3d compliance;            ///< m/N, in the tool's frame
  Eigen::Vector3d principal_compliance;  ///< m/N, largest first; 0 where the arm cannot yield
  /// Along the tool's x, y, z, N/m; infinite where the arm cannot yield (at a singular pose).
  Eigen::Vector3d directional_stiffness;
  std::optional<Eigen::Vector3d> deflection_m;  ///< under the force, base frame
  double limit_margin_rad = 0;
  JointAngles joint_margin_rad;   ///< of each joint
  double singularity_margin = 0;  ///< singularity_margin() of the pose
  double keep_out_margin_m = 0;   ///< keep_out_margin_m() of the pose
  /// With which the deflection is largest, where the task's force varies; base frame, N.
  std::optional<Eigen::Vector3d> worst_force_n;
  double largest_deflection_m = 0;   ///< under that
  std::optional<CutDeflection> cut;  ///< where the task has a cut
  /// Standard deviations of what a measurement will show: by linear propagation of the compliances'
  /// covariance [JCGM2008, 5.2], and the discrepancy. Absent where neither is known.
  std::optional<double> score_std, deflection_std_m;
  Eigen::VectorXd score_gradient;   ///< d score / d compliance, of each spring
  double discrepancy_variance = 0;  ///< what the discrepancy adds to score_std^2
};

/// `errors` of the elasticity's springs. A force is needed for the index deflection.
PoseReport report_pose(const Robot& robot, const JointAngles& angles, const StiffnessTask& task,
                       const Elasticity& elasticity, const ElasticityErrors& errors);

/// Probability that pose a is better than pose b by the task's index, for normal errors: the compliances are
/// those of both, the discrepancies each pose's own.
double probability_better(const PoseReport& a, const PoseReport& b, const StiffnessTask& task,
                          const ElasticityErrors& errors);

}  // namespace stablecut::robot
