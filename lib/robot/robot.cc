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

JointAngles most_central_copies(const Robot& robot, const JointAngles& angles) {
  JointAngles moved = angles;
  for (int j = 0; j < kJoints; ++j) {
    moved[j] += kTwoPi * std::nearbyint((robot.joints[j].middle_rad() - angles[j]) / kTwoPi);
  }
  return moved;
}

double limit_margin_rad(const Robot& robot, const JointAngles& angles) {
  double margin = std::numeric_limits<double>::infinity();
  for (int j = 0; j < kJoints; ++j) margin = std::min(margin, robot.joints[j].margin_rad(angles[j]));
  return margin;
}

ToolAlignment tool_alignment(const Robot& robot) {
  const Eigen::Isometry3d tool = robot.tool_in_frame6();
  return {tool.translation().head<2>().norm() <= kAlignmentTolerance,
          tool.linear().col(2).head<2>().norm() <= kAlignmentTolerance};
}

}  // namespace stablecut::robot
