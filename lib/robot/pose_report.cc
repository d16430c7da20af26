#include "robot/pose_report.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "numerics/distributions.h"
#include "robot/compliance_slope.h"
#include "robot/keep_out.h"

namespace stablecut::robot {
namespace {

constexpr double kRigid = 1e-12;  // of the largest principal compliance: below, rounding

// Of a stiffness, as a share of it. A discrepancy that does not say which load its absolute part belongs to
// is one of the task's force; without any that part cannot be told as a share.
double relative_variance(Discrepancy discrepancy, double stiffness, const StiffnessTask& task) {
  if (!(discrepancy.force_n > 0)) {
    discrepancy.force_n = task.cut ? task.cut->mean_n.norm() : task.force_n ? task.force_n->norm() : 1;
    if (!task.has_force()) discrepancy.absolute_m = 0;
  }
  return discrepancy.relative_variance(1 / stiffness);
}

// A score that is better smaller is a deflection, or a component of one, else a stiffness. One that is made
// of the stiffness along several axes of the tool is off, as a share, by no more than the worst of them,
// however they hang together.
double score_discrepancy(const PoseReport& report, const StiffnessTask& task,
                         const Discrepancy& discrepancy) {
  if (discrepancy.none()) return 0;
  if (task.index->needs_cut) return discrepancy.variance(report.largest_deflection_m);
  if (!task.index->larger_is_better) return discrepancy.variance(report.score);
  double share = 0;
  for (int i = 0; i < 3; ++i) {
    if (task.index->along[i])
      share = std::max(share, relative_variance(discrepancy, report.directional_stiffness[i], task));
  }
  if (task.index->along == std::array<bool, 3>{}) share = relative_variance(discrepancy, report.score, task);
  return share * report.score * report.score;
}

}  // namespace

PoseReport report_pose(const Robot& robot, const JointAngles& angles, const StiffnessTask& task,
                       const Elasticity& elasticity, const ElasticityErrors& errors) {
  const RobotPose pose = robot_pose(robot, angles);
  const Eigen::Matrix3d compliance = translational_compliance(pose, elasticity);
  const Eigen::Matrix3d axes = pose.tool.linear();
  PoseReport report;
  report.angles = angles;
  report.tool = pose.tool;
  report.redundancy_rad = redundancy_angle(pose.tool);
  report.score = stiffness_score(compliance, axes, task);
  report.compliance = axes.transpose() * compliance * axes;
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
  for (int j = 0; j < kJoints; ++j) report.joint_margin_rad[j] = robot.range(j, angles).margin_rad(angles[j]);
  report.singularity_margin = singularity_margin(pose);
  report.keep_out_margin_m = keep_out_margin_m(robot, pose);
  if (task.has_force() && load_in_base(task, axes).varies()) {
    report.worst_force_n = worst_force(task, compliance, axes);
    report.largest_deflection_m = (compliance * *report.worst_force_n).norm();
  }
  if (task.cut) report.cut = cut_deflection(pose, task, elasticity, errors);
  report.score_gradient =
      compliance_gradient(pose, elasticity.springs, compliance,
                          [&](const Eigen::Matrix3d& c) { return stiffness_score(c, axes, task); });
  if (errors.known() && std::isfinite(report.score)) {
    report.discrepancy_variance = score_discrepancy(report, task, errors.discrepancy);
    report.score_std = std::sqrt(propagated(report.score_gradient, errors) + report.discrepancy_variance);
  }
  if (task.has_force()) {
    const Eigen::Vector3d force = force_in_base(task, axes);
    report.deflection_m = compliance * force;
    if (errors.known()) {
      const Eigen::VectorXd slope = compliance_gradient(
          pose, elasticity.springs, compliance, [&](const Eigen::Matrix3d& c) { return (c * force).norm(); });
      report.deflection_std_m =
          std::sqrt(propagated(slope, errors) + errors.discrepancy.variance(report.deflection_m->norm()));
    }
  }
  return report;
}

double probability_better(const PoseReport& a, const PoseReport& b, const StiffnessTask& task,
                          const ElasticityErrors& errors) {
  const double lead = (a.score - b.score) * (task.index->larger_is_better ? 1 : -1);
  const double spread = std::sqrt(propagated(a.score_gradient - b.score_gradient, errors) +
                                  a.discrepancy_variance + b.discrepancy_variance);
  if (!(spread > 0)) return lead > 0 ? 1 : lead < 0 ? 0 : 0.5;
  return numerics::normal_cdf(lead / spread);
}

}  // namespace stablecut::robot
