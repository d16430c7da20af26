// From which samples of a scanned plane the refinement starts. README.md, "Starts".
#pragma once

#include <vector>

#include "robot/plane_scan.h"

namespace stablecut::robot {

/// Starts of each arm: the best point of each of 16 blocks of the plane, and the local optima of the grid,
/// the best first and not close together.
std::vector<PlanePoint> starts_at_optima(const PlaneScan& scan);

/// For a plane without an allowed sample, as an allowed sliver may lie between the samples: the points that
/// miss the limits by the least, the nearest first.
std::vector<PlanePoint> starts_nearest_to_limits(const PlaneScan& scan);

}  // namespace stablecut::robot
