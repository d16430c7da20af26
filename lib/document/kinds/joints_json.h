// Lists of three and of six numbers: vectors, joint angles, values per joint.
#pragma once

#include <optional>

#include "document/text/node.h"
#include "robot/robot.h"

namespace stablecut::document {

/// [x, y, z].
Eigen::Vector3d vector_from(const Node& node, const Bound& bound = kAnyNumber);

/// Six angles in degrees, as radians.
robot::JointAngles joint_angles_from(const Node& node);
Json joint_angles_to_json(const robot::JointAngles& angles);

/// An angle in degrees, to 1e-12: what was 30 degrees in an input is 30 again.
double document_degrees(double rad);

/// A number, or null.
Json number_or_null(std::optional<double> value);

}  // namespace stablecut::document
