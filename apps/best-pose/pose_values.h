// The values of best-pose's own options.
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>

#include "robot/path_place.h"
#include "robot/robot.h"

namespace stablecut {

/// The box of `--keep-out XFROM:XTO,YFROM:YTO,ZFROM:ZTO`, mm. Throws WrongUsage.
robot::Box parse_box(const std::string& text);

/// The places of `--place`: three intervals in x, y and turn, or four in x, y, z and turn; mm and deg. Throws
/// WrongUsage, also for more places than one run tries.
robot::PlaceGrid place_grid(const std::string& text);

/// The tool point of `--tool-point`, m, from mm in the flange frame. Throws WrongUsage.
Eigen::Vector3d tool_point_m(const std::array<double, 3>& point_mm);

/// Largest speeds of the joints, rad/s: `--joint-speed`, one number or one for each joint, deg/s; of an empty
/// text the robot's own, or 60 deg/s. Throws WrongUsage.
robot::JointAngles joint_speeds(const std::string& text, const robot::Robot& robot);

}  // namespace stablecut
