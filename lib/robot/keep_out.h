// What the tool must not come near. README.md, "Paths".
#pragma once

#include "robot/kinematics.h"

namespace stablecut::robot {

/// Distance (m) from the straight tool, flange to tool point, to the cylinder of Robot::keep_out_radius_m
/// round axis 1, which has no ends; negative inside. Infinite where the robot has no such cylinder.
double keep_out_margin_m(const Robot& robot, const RobotPose& pose);

}  // namespace stablecut::robot
