// The singularity margin of four arms side by side. README.md, "Paths".
#pragma once

#include "robot/arm_lanes.h"

namespace stablecut::robot {

/// For each arm whether the least singular value of the Jacobian at the tool point (home frame, m; lengths in
/// m) is above `margin`: whether J J^T - margin^2 is positive definite.
void arms_away_from_singularities(const ArmLanes& lanes, const double point[3], double margin,
                                  bool away[kArms]);

}  // namespace stablecut::robot
