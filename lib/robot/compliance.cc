#include "robot/compliance.h"

#include <Eigen/Eigenvalues>
#include <algorithm>

namespace stablecut::robot {
namespace {

constexpr double kClosedFormGap = 1e-3;  // of the spread of the eigenvalues

}  // namespace

Eigen::Matrix3d translational_compliance(const RobotPose& pose, const JointAngles& joint_compliance) {
  const auto columns = translational_jacobian(pose, pose.tool.translation());
  return columns * joint_compliance.asDiagonal() * columns.transpose();
}

Eigen::Matrix3d translational_compliance(const RobotPose& pose, const Elasticity& elasticity) {
  if (elasticity.springs.size() == kJoints)
    return translational_compliance(pose, JointAngles(elasticity.compliance));
  return compliance_at(pose, elasticity.springs, elasticity.compliance, pose.tool.translation());
}

Eigen::Vector3d principal_compliances(const Eigen::Matrix3d& compliance) {
  // The closed form [Smith1961] loses digits where two eigenvalues nearly meet: there by iteration.
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(compliance, Eigen::EigenvaluesOnly);
  const Eigen::Vector3d& direct = solver.eigenvalues();
  const double gap = std::min(direct[2] - direct[1], direct[1] - direct[0]);
  if (!(gap > kClosedFormGap * (direct[2] - direct[0]))) solver.compute(compliance, Eigen::EigenvaluesOnly);
  return solver.eigenvalues().reverse();
}

}  // namespace stablecut::robot
