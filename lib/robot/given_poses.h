// What can be said of joint angles that a user gives, before they are used.
#pragma once

#include <optional>
#include <vector>

#include "robot/robot.h"

namespace stablecut::robot {

/// A pose outside the joint limits.
struct OutsideLimits {
  int pose = 0;           ///< index
  int joint = 0;          ///< index: the joint that is farthest outside
  double beyond_rad = 0;  ///< by how much
};

/// The poses that are outside the limits by more than rounding, in their order.
std::vector<OutsideLimits> poses_outside_limits(const Robot& robot, const std::vector<JointAngles>& poses);

/// The largest angle as it was written, in degrees, where all of them are so small that they look like
/// radians that were taken for degrees; nothing where they do not.
std::optional<double> looks_like_radians(const std::vector<JointAngles>& poses);

}  // namespace stablecut::robot
