// What joint-stiffness says about the joint angles that it is given.
#pragma once

#include <string>
#include <vector>

#include "robot/robot.h"

namespace stablecut {

/// How many of the poses are outside the joint limits, and the first of them: "2 of 9 poses are outside the
/// joint limits, the first /poses/3: A2 by 5 degrees". Empty where none is. `poses` is what they are called.
std::string outside_limits_text(const robot::Robot& robot, const std::vector<robot::JointAngles>& angles,
                                const std::vector<std::string>& places, const std::string& poses);

/// That the angles look like radians; empty where they do not.
std::string radians_text(const std::vector<robot::JointAngles>& angles);

}  // namespace stablecut
