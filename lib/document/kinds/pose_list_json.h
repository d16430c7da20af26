// Kind `pose-list`: joint angles to judge or to choose from.
#pragma once

#include <string>
#include <vector>

#include "document/text/json_text.h"
#include "robot/robot.h"

namespace stablecut::document {

struct PoseListDocument {
  std::vector<robot::JointAngles> poses;
  std::vector<std::string> names;  ///< of each; empty where it has none
};

/// Throws DataError.
PoseListDocument pose_list_from_json(const Json& document, const Source& source);

}  // namespace stablecut::document
