#include "robot/compliance.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace stablecut::robot {

Eigen::Matrix3d translational_compliance(const RobotPose& pose, const JointAngles& joint_compliance) {
  const auto columns = translational_jacobian(pose, pose.tool.translation());
  return columns * joint_compliance.asDiagonal() * columns.transpose();
}

Eigen::Vector3d principal_compliances(const Eigen::Matrix3d& compliance) {
  // The closed form loses digits where two eigenvalues nearly meet; then the iteration.
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(compliance, Eigen::EigenvaluesOnly);
  const Eigen::Vector3d& direct = solver.eigenvalues();
  const double gap = std::min(direct[2] - direct[1], direct[1] - direct[0]);
  if (!(gap > 1e-3 * (direct[2] - direct[0]))) solver.compute(compliance, Eigen::EigenvaluesOnly);
  return solver.eigenvalues().reverse();
}

Eigen::Vector3d force_in_base(const StiffnessTask& task, const Eigen::Matrix3d& tool_rotation) {
  if (!task.force_n) throw InvalidArgument("force: missing: expected a force");
  return task.force_in_tool ? Eigen::Vector3d(tool_rotation * *task.force_n) : *task.force_n;
}

double stiffness_score(const Eigen::Matrix3d& compliance, const Eigen::Matrix3d& tool_rotation,
                       const StiffnessTask& task) {
  switch (task.index) {
    case StiffnessIndex::kCombined: {
      double sum = 0;
      for (int i = 0; i < 3; ++i) sum += 1 / (compliance * tool_rotation.col(i)).squaredNorm();
      return std::sqrt(sum);
    }
    case StiffnessIndex::kWeakest:
      return 1 / principal_compliances(compliance)[0];
    case StiffnessIndex::kAxial:
      return directional_stiffness(compliance, tool_rotation.col(2));
    case StiffnessIndex::kDeflection:
      break;
  }
  return (compliance * force_in_base(task, tool_rotation)).norm();
}

}  // namespace stablecut::robot
