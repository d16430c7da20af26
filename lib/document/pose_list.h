// Kind `pose-list`: joint angles to judge or to choose from.
#pragma once

#include <vector>

#include "document/json_text.h"
#include "robot/robot.h"

namespace stablecut {

/// Throws DataError.
std::vector<JointAngles> pose_list_from_json(const Json& document, const Source& source);

}  // namespace stablecut
