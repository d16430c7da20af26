// The number of multipliers outside the unit circle, which confirms the passages that were found. README.md,
// "Limits from the unit circle".
#pragma once

#include <optional>
#include <vector>

#include "milling/circle_lanes.h"
#include "milling/circle_scan.h"

namespace stablecut::milling {

/// The number of multipliers outside the unit circle at a depth: det(I - depth M) goes round 0 that often,
/// backwards, while mu goes once round the circle. Half of it is enough. Places are added to the `angles`
/// where the phase changes too much; nothing is known where that does not end.
std::optional<int> winding(CircleLanes& lanes, std::vector<double> angles, double depth_m);

/// Depths up to the largest at which multipliers are counted, away from the passages.
std::vector<double> depths_to_count_at(const std::vector<CirclePassage>& found, double largest_depth_m);

/// What the passages below a depth add up to.
int unstable_at(const std::vector<CirclePassage>& found, double depth_m);

}  // namespace stablecut::milling
