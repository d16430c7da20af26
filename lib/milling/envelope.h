// The chart of several structures at once: poses of a robot, or tools, that one cut must suit.
#pragma once

#include <vector>

#include "milling/lobes.h"

namespace stablecut::milling {

/// What is stable for all: the largest radius and error at each speed and depth, and the depths at which the
/// first structure becomes unstable or the last one stable again, with the index of that structure. `charts`
/// of the same speeds and depths, at least one.
StabilityChart envelope_of(const std::vector<StabilityChart>& charts);

}  // namespace stablecut::milling
