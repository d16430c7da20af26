#include "robot/robot.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/units.h"

namespace stablecut::robot {
namespace {

constexpr double kWholeRounding = 1e-14;      // of the sine or cosine of a right angle
constexpr double kAlignmentTolerance = 1e-9;  // m, and the sine of an angle

}  // namespace

void Joint::set_alpha(double rad) {
  const auto without_rounding = [](double value) {
    return std::abs(value - std::nearbyint(value)) < kWholeRounding ? std::nearbyint(value) : value;
  };
  alpha_rad_ = rad;
  cos_alpha_ = without_rounding(std::cos(rad));
  sin_alpha_ = without_rounding(std::sin(rad));
}

double Robot::turn_rad(int j, const JointAngles& angles) const {
  const auto& coupling = joints[j].coupling;
  return coupling ? angles[j] + coupling->ratio * angles[coupling->follows] : angles[j];
}

// Both intervals hold at once, so that their intersection is one, and the least of the four distances to
// their ends is the distance to its ends.
AngleRange Robot::range(int j, const JointAngles& angles) const {
  const Joint& joint = joints[j];
  if (!joint.coupling) return {joint.min_rad, joint.max_rad};
  const double added = joint.coupling->ratio * angles[joint.coupling->follows];
  return {std::max(joint.min_rad, joint.coupled_min_rad - added),
          std::min(joint.max_rad, joint.coupled_max_rad - added)};
}

JointAngles joint_turns(const Robot& robot, const JointAngles& angles) {
  JointAngles turns;
  for (int j = 0; j < kJoints; ++j) turns[j] = robot.turn_rad(j, angles);
  return turns;
}

JointAngles angles_of_turns(const Robot& robot, const JointAngles& turns) {
  JointAngles angles = turns;
  for (int j = 0; j < kJoints; ++j) {
    if (const auto& c = robot.joints[j].coupling) angles[j] -= c->ratio * angles[c->follows];
  }
  return angles;
}

JointAngles most_central_copies(const Robot& robot, const JointAngles& angles) {
  JointAngles moved = joint_turns(robot, angles);
  for (int j = 0; j < kJoints; ++j) {
    if (const auto& c = robot.joints[j].coupling) moved[j] -= c->ratio * moved[c->follows];
    moved[j] += kTwoPi * std::nearbyint((robot.range(j, moved).middle_rad() - moved[j]) / kTwoPi);
  }
  return moved;
}

double limit_margin_rad(const Robot& robot, const JointAngles& angles) {
  double margin = std::numeric_limits<double>::infinity();
  for (int j = 0; j < kJoints; ++j) margin = std::min(margin, robot.range(j, angles).margin_rad(angles[j]));
  return margin;
}

ToolAlignment tool_alignment(const Robot& robot) {
  const Eigen::Isometry3d tool = robot.tool_in_frame6();
  return {tool.translation().head<2>().norm() <= kAlignmentTolerance,
          tool.linear().col(2).head<2>().norm() <= kAlignmentTolerance};
}

}  // namespace stablecut::robot
