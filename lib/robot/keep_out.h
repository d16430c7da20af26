// What tool and links must not come near: the column, the floor, boxes. README.md, "Keep-out".
#pragma once

#include "robot/kinematics.h"

namespace stablecut::robot {

/// The least distance (m) from the straight tool (flange to tool point) and the links' capsules to the
/// cylinder of Robot::keep_out_radius_m round axis 1, the floor and the boxes; negative where one is inside,
/// infinite where the robot has none of them. The cylinder counts for the tool and the links from the forearm
/// on, which are not hinged to it; floor and boxes for the upper arm too. Inside a
/// box the distance is that to the nearest face, negative.
double keep_out_margin_m(const Robot& robot, const RobotPose& pose);

/// The least radius (m) that the column takes about axis 1, by the robot's own dimensions: where base and
/// first link have capsules, what these sweep; else where axis 2 carries the upper arm, which the column has
/// to reach.
double column_radius_m(const Robot& robot);

}  // namespace stablecut::robot
