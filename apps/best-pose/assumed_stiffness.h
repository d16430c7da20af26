// --assume: a stiffness for a joint that the joint-stiffness document has none for.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "document/text/json_text.h"
#include "robot/joint_stiffness.h"
#include "robot/robot.h"

namespace stablecut {

/// A joint's name and its stiffness, N m/rad.
using AssumedStiffness = std::pair<std::string, double>;

/// Reads JOINT=K. Throws WrongUsage.
AssumedStiffness parse_assumed(const std::string& text);

/// What yields: the joints by the document's stiffness (`source` is where it came from), or the assumed one
/// of a joint without, and the document's other springs, rigid where it has no compliance for one. Throws
/// WrongUsage where an assumption names no joint or one that has a stiffness, and NoAnswer where a joint is
/// left without.
robot::Elasticity complete_elasticity(robot::JointStiffness joints,
                                      const std::vector<AssumedStiffness>& assumed, const robot::Robot& robot,
                                      const document::Source& source);

}  // namespace stablecut
