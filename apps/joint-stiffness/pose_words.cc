#include "pose_words.h"

#include "base/number_text.h"
#include "base/units.h"
#include "robot/given_poses.h"

namespace stablecut {

std::string outside_limits_text(const robot::Robot& robot, const std::vector<robot::JointAngles>& angles,
                                const std::vector<std::string>& places, const std::string& poses) {
  const auto outside = robot::poses_outside_limits(robot, angles);
  if (outside.empty()) return "";
  const robot::OutsideLimits& first = outside.front();
  return std::to_string(outside.size()) + " of " + std::to_string(angles.size()) + " " + poses +
         " are outside the joint limits, the first " + places[first.pose] + ": " +
         robot.joints[first.joint].name + " by " + number_text(degrees_from_radians(first.beyond_rad), 3) +
         " degrees";
}

std::string radians_text(const std::vector<robot::JointAngles>& angles) {
  const auto largest = robot::looks_like_radians(angles);
  if (!largest) return "";
  return "the joint angles look like radians: the largest is " + number_text(*largest, 3) +
         ", expected degrees";
}

}  // namespace stablecut
