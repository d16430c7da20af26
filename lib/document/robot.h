// Kind `robot`: a six-joint arm in modified Denavit-Hartenberg form, its flange and tool.
#pragma once

#include "document/json_text.h"
#include "robot/robot.h"

namespace stablecut {

/// Throws DataError.
Robot robot_from_json(const Json& document, const Source& source);

}  // namespace stablecut
