// Frames: where one thing lies in another.
#pragma once

#include <Eigen/Geometry>

#include "document/text/node.h"

namespace stablecut::document {

/// `{"translation_mm", "rotation"}`, the rotation as rows; m.
Eigen::Isometry3d frame_from(const Node& node);

Json frame_to_json(const Eigen::Isometry3d& frame);

}  // namespace stablecut::document
