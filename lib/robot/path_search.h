// The stiffest motion along a tool path: redundancy, branch and joint angles at each point. README.md,
// "Paths".
#pragma once

#include <optional>
#include <vector>

#include "base/progress.h"
#include "robot/path_chain.h"

namespace stablecut::robot {

struct PathPose {
  double turn = 0;  ///< of the tool, rad, as PathFrames counts it
  JointAngles angles;
  double cost = 0;                          ///< path_cost()
  double time = 0;                          ///< s from the first point of the part
  JointAngles speed = JointAngles::Zero();  ///< rad/s, of the move that leads here; 0 for the first
};

/// Points that one motion runs through.
struct PathPart {
  std::size_t first = 0;
  int branch = 0;
  std::vector<PathPose> poses;
  double objective = 0;  ///< the largest cost, or the mean

  std::size_t last() const { return first + poses.size() - 1; }
};

/// What a path breaks, and where: no pose is allowed at the points, or no motion leads from the first to the
/// last.
struct PathObstacle {
  std::size_t first = 0, last = 0;
  bool between = false;  ///< the points by themselves are reached, and not the one from the other
  bool speed = false;    ///< of `between`: the joint's speed is not enough, by the factor `missing`
  /// What would be broken by the least where it is broken by the most.
  PoseFault fault;
};

struct PathSearch {
  std::vector<PathPart> parts;
  std::vector<PathObstacle> obstacles;  ///< empty where one part holds all points
};

/// Dynamic programming on a ladder of a degree, all branches and copies, then on finer ladders about what was
/// found. What it finds keeps all limits, and is not worse than the ladder's best.
PathSearch search_path(const PathModel& model, int threads, const Progress& progress = {});

/// The motion through the whole path, if there is one: search_path() without what is said of obstacles.
std::optional<PathPart> search_motion(const PathModel& model, int threads);

/// Why the worst point of a part is not better.
struct WorstPoint {
  enum class Reason {
    kPlace,      ///< no redundancy and no branch is better there
    kFault,      ///< what is better breaks a rule
    kBranch,     ///< what is better is on a branch that does not lead through
    kNeighbours  ///< what is better is too far from what the points beside it allow
  };
  std::size_t point = 0;
  Reason reason = Reason::kPlace;
  PoseFault fault;         ///< of kFault
  double better_cost = 0;  ///< of what would be better there, by itself
};
WorstPoint worst_point(const PathModel& model, const PathPart& part);

}  // namespace stablecut::robot
