// The stiffest pose over a plane, the redundancy about the tool axis and all branches. README.md, "Search".
#pragma once

#include <vector>

#include "base/progress.h"
#include "robot/plane_scan.h"
#include "robot/pose_families.h"

namespace stablecut::robot {

struct PoseSearch {
  FoundPose best;
  /// Other local optima, best first, without members of the best pose's families.
  std::vector<FoundPose> alternatives;
  std::vector<PoseFamily> families;  ///< of the best pose
  bool redundancy_matters = true;
};

/// The optimum within the task's intervals, wherever the samples lie: a scan in steps of at most 50 mm and 5
/// degrees, of at least 25 points an interval and not coarser than the task's samples (`known`, where it is
/// that scan already), then every local optimum refined, with the limits, the singularity margin and the
/// intervals held. Throws NoPose when nothing is allowed.
PoseSearch search_poses(const Robot& robot, const PoseTask& task, int most_alternatives, int threads,
                        const Progress& progress = {}, const PlaneScan* known = nullptr);

}  // namespace stablecut::robot
