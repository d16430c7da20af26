// Samples that belong together: those of one pose, and those of neighbouring poses.
#pragma once

#include <vector>

#include "robot/load_sample.h"

namespace stablecut::robot {

struct SampleGroups {
  std::vector<int> of_sample;  ///< group of each sample, 0 to count - 1 in the order of first appearance
  int count = 0;
};

/// Samples whose joint angles agree to 0.1 degrees, whatever their loads.
SampleGroups groups_by_pose(const std::vector<LoadSample>& samples);

/// Blocks of neighbouring poses: at most ten centres, each the pose farthest in joint angles from those
/// before it, and every pose with its nearest centre [Gonzalez1985].
SampleGroups groups_by_block(const std::vector<LoadSample>& samples, const SampleGroups& poses);

}  // namespace stablecut::robot
