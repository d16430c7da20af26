// What holds a pose where it is, and what it costs to move the part. README.md, "What an answer stands on".
#pragma once

#include <optional>
#include <vector>

#include "robot/pose_report.h"
#include "robot/pose_search.h"

namespace stablecut::robot {

/// What a pose stands on, to 1e-6 (rad, m, of the singularity margin); nothing of it: it is interior.
struct Standing {
  std::vector<int> joints;  ///< with the limit margin and no more
  bool singularity = false, keep_out = false;
  bool x = false, y = false, redundancy = false;  ///< an end of the task's interval, unless that is a point
};
Standing standing_of(const PoseTask& task, const PoseReport& report, const PlanePoint& at);

/// The part moved, with the tool point, axis and force fixed to it, or turned about the tool point.
struct PartMove {
  bool turn = false;
  int axis = 0;                 ///< x, y or normal of the plane
  double amount = 0;            ///< m or rad
  std::optional<double> score;  ///< the best there, on any branch; nothing where no pose is allowed
};

/// What moving the part by 50 mm either way along the plane's axes and its normal, and turning it by 5
/// degrees about them, makes of a found pose's score.
std::vector<PartMove> part_moves(const Robot& robot, const PoseTask& task, const FoundPose& found);

}  // namespace stablecut::robot
