// Kind `pose-list`: joint angles to judge or to choose from.
#pragma once

#include <vector>

#include "document/text/json_text.h"
#include "robot/robot.h"

namespace stablecut::document {

/// Throws DataError.
std::vector<robot::JointAngles> pose_list_from_json(const Json& document, const Source& source);

}  // namespace stablecut::document
