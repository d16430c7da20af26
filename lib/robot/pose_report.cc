#include "robot/pose_report.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "numerics/distributions.h"

namespace stablecut::robot {
namespace {

constexpr double kGradientStep = 1e-5;  // of a compliance
constexpr double kRigid = 1e-12;        // of the largest principal compliance: below, rounding

// d value(C) / d c_j by central differences; C is linear in the compliances.
template <typename Value>
JointAngles gradient(const RobotPose& pose, const JointAngles& joint_compliance, const Value& value) {
  const auto columns = translational_jacobian(pose, pose.tool.translation());
  const Eigen::Matrix3d compliance = translational_compliance(pose, joint_compliance);
  JointAngles result;
  for (int j = 0; j < kJoints; ++j) {
    const double step = kGradientStep * joint_compliance[j];
    const Eigen::Matrix3d change = step * columns.col(j) * columns.col(j).transpose();
    result[j] = (value(compliance + change) - value(compliance - change)) / (2 * step);
  }
  return result;
}

double deviation(const JointAngles& slope, const Matrix6d& covariance) {
  return std::sqrt(std::max(0.0, slope.dot(covariance * slope)));
}

}  // namespace

PoseReport report_pose(const Robot& robot, const JointAngles& angles, const StiffnessTask& task,
                       const JointAngles& joint_compliance, const std::optional<Matrix6d>& covariance) {
  const RobotPose pose = robot_pose(robot, angles);
  const Eigen::Matrix3d compliance = translational_compliance(pose, joint_compliance);
  const Eigen::Matrix3d axes = pose.tool.linear();
  PoseReport report;
  report.angles = angles;
  report.tool = pose.tool;
  report.redundancy_rad = redundancy_angle(pose.tool);
  report.score = stiffness_score(compliance, axes, task);
  report.principal_compliance = principal_compliances(compliance);
  // Rounding leaves about 1e-16 of the compliance where the arm cannot yield at all.
  const double rigid = kRigid * report.principal_compliance[0];
  report.principal_compliance =
      (report.principal_compliance.array() > rigid).select(report.principal_compliance, 0.0);
  for (int i = 0; i < 3; ++i) {
    const double yielded = (compliance * axes.col(i)).norm();
    report.directional_stiffness[i] = yielded > rigid ? 1 / yielded : std::numeric_limits<double>::infinity();
  }
  for (int i = 0; i < 3; ++i) {
    if (task.index->along[i] && std::isinf(report.directional_stiffness[i])) {
      report.score = std::numeric_limits<double>::quiet_NaN();
    }
  }
  report.limit_margin_rad = limit_margin_rad(robot, angles);
  report.singularity_margin = singularity_margin(pose);
  report.score_gradient = gradient(pose, joint_compliance,
                                   [&](const Eigen::Matrix3d& c) { return stiffness_score(c, axes, task); });
  if (covariance && std::isfinite(report.score))
    report.score_std = deviation(report.score_gradient, *covariance);
  if (task.force_n) {
    const Eigen::Vector3d force = force_in_base(task, axes);
    report.deflection_m = compliance * force;
    if (covariance) {
      report.deflection_std_m = deviation(
          gradient(pose, joint_compliance, [&](const Eigen::Matrix3d& c) { return (c * force).norm(); }),
          *covariance);
    }
  }
  return report;
}

double probability_better(const PoseReport& a, const PoseReport& b, const StiffnessTask& task,
                          const Matrix6d& covariance) {
  const double lead = (a.score - b.score) * (task.index->larger_is_better ? 1 : -1);
  const double spread = deviation(a.score_gradient - b.score_gradient, covariance);
  if (!(spread > 0)) return lead > 0 ? 1 : lead < 0 ? 0 : 0.5;
  return numerics::normal_cdf(lead / spread);
}

}  // namespace stablecut::robot
