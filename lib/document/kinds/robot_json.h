// Kind `robot`: a six-joint arm in modified Denavit-Hartenberg form, its flange and tool.
#pragma once

#include "document/text/json_text.h"
#include "robot/robot.h"

namespace stablecut::document {

/// Throws DataError.
robot::Robot robot_from_json(const Json& document, const Source& source);

}  // namespace stablecut::document
