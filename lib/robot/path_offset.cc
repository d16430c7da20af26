#include "robot/path_offset.h"

#include <cmath>
#include <limits>
#include <optional>

#include "base/units.h"

namespace stablecut::robot {
namespace {

constexpr int kMostOffsetSteps = 20;     // a guard: each gains the share of a metre that the offset is
constexpr double kOffsetSettled = 1e-9;  // m

// The angles that bring the tool there, as near to those of the pose as there are; nothing out of reach.
std::optional<JointAngles> angles_at(const InverseKinematics& inverse, const Eigen::Isometry3d& tool,
                                     const JointAngles& near) {
  std::optional<JointAngles> nearest;
  double least = std::numeric_limits<double>::infinity();
  for (const InverseSolution& solution : inverse.solve(tool, near)) {
    double distance = 0;
    for (int j = 0; j < kJoints; ++j)
      distance = std::max(distance, std::abs(std::remainder(solution.angles[j] - near[j], kTwoPi)));
    if (distance < least) {
      least = distance;
      nearest = solution.angles;
    }
  }
  return nearest;
}

}  // namespace

Eigen::Vector3d cancelling_offset(const Robot& robot, const InverseKinematics& inverse,
                                  const PoseReport& report, const StiffnessTask& task,
                                  const Elasticity& elasticity) {
  const Eigen::Vector3d force = force_in_base(task, report.tool.linear());
  Eigen::Vector3d offset = -*report.deflection_m;
  for (int step = 0; step < kMostOffsetSteps; ++step) {
    Eigen::Isometry3d tool = report.tool;
    tool.translation() += offset;
    const auto angles = angles_at(inverse, tool, report.angles);
    if (!angles) break;  // at the edge of the reach: as the pose itself yields
    const Eigen::Vector3d next = -translational_compliance(robot_pose(robot, *angles), elasticity) * force;
    const double change = (next - offset).norm();
    offset = next;
    if (change <= kOffsetSettled) break;
  }
  return offset;
}

}  // namespace stablecut::robot
