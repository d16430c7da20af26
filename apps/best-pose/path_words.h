// What best-pose says about paths.
#pragma once

#include <string>
#include <vector>

#include "robot/path_place.h"
#include "robot/path_search.h"

namespace stablecut {

/// Why no place of a grid lets a path be driven.
std::string no_place_text(const robot::PlaceSearch& search);

/// Which points of a path cannot be driven, and why; empty where there are none.
std::string obstacles_text(const std::vector<robot::PathObstacle>& obstacles, const robot::Robot& robot,
                           const robot::PathTask& task);

}  // namespace stablecut
