// What keeps a path from being driven in one motion. README.md, "Paths".
#pragma once

#include "robot/path_search.h"

namespace stablecut::robot {

/// Of a path of which these parts, in order, are driven; neighbouring points with the same obstacle together.
std::vector<PathObstacle> path_obstacles(const PathModel& model, const std::vector<StepLimit>& limits,
                                         const std::vector<PathPart>& parts, int threads);

}  // namespace stablecut::robot
