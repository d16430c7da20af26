// The stiffest pose over a plane, the redundancy about the tool axis and all branches.
#pragma once

#include <vector>

#include "base/progress.h"
#include "robot/plane_scan.h"
#include "robot/pose_families.h"

namespace stablecut::robot {

struct PoseSearch {
  FoundPose best;
  std::vector<FoundPose>
      alternatives;  ///< other local optima, best first, without members of the best's families
  std::vector<PoseFamily> families;
  bool redundancy_matters = true;
};

/// The optimum within the task's intervals, wherever the samples lie: a scan at most 50 mm and 5 degrees
/// apart, of 25 points an interval at least and not coarser than the task's samples (`known`, where it is
/// that scan already), then every local optimum refined, with the limits, the singularity margin and the
/// intervals held. Throws NoAnswer when nothing is allowed, saying what stands in the way.
PoseSearch search_poses(const Robot& robot, const PoseTask& task, int most_alternatives, int threads,
                        const Progress& progress = {}, const PlaneScan* known = nullptr);

}  // namespace stablecut::robot
