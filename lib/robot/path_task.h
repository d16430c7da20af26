// The question of a path search: where the tool goes, what counts as stiff, and what has to be kept.
#pragma once

#include <limits>

#include "base/range.h"
#include "robot/joint_stiffness.h"
#include "robot/stiffness_index.h"
#include "robot/tool_path.h"

namespace stablecut::robot {

struct PathTask {
  ToolPath path;
  StiffnessTask stiffness;
  bool force_in_feed = false;  ///< the force is given in PathFrames::feed, else as StiffnessTask says
  Elasticity elasticity;
  bool mean_objective = false;      ///< the mean cost along the path, else the largest, is to be least
  std::optional<Range> redundancy;  ///< interval of redundancy_angle(), rad; its count does not matter
  double limit_margin_rad = 0;      ///< least distance to keep from every joint limit
  double singularity_margin = 0;    ///< least singularity_margin() to keep
  JointAngles max_speed = JointAngles::Constant(std::numeric_limits<double>::infinity());  ///< rad/s
  /// Most turning of the tool about its own axis, rad/m of path.
  double most_turn_per_metre = std::numeric_limits<double>::infinity();
};

/// What is least along a path: the score where smaller is better, else its inverse, so that stiff is small.
inline double path_cost(const StiffnessIndex& index, double score) {
  return index.larger_is_better ? 1 / score : score;
}

/// The task of one point, with its force in the base or the tool's frame, for report_pose().
StiffnessTask point_task(const PathTask& task, const PathFrames& frames, std::size_t point);

}  // namespace stablecut::robot
