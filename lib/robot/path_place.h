// Where to put a workpiece: the path searched at each place of a grid. README.md, "Places".
#pragma once

#include <optional>
#include <vector>

#include "base/progress.h"
#include "base/range.h"
#include "robot/path_task.h"

namespace stablecut::robot {

/// How a workpiece stands otherwise than its path says: moved, and turned about the base frame's z through
/// the origin of its own frame.
struct Placement {
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();  ///< m, base frame
  double turn = 0;                                  ///< rad

  /// Of the workpiece in the base frame, where it was `workpiece` before.
  Eigen::Isometry3d frame(const Eigen::Isometry3d& workpiece) const;
};

/// The path (base frame) of the workpiece as it then stands.
ToolPath placed(const ToolPath& path, const Placement& placement, const Eigen::Isometry3d& workpiece);

/// All combinations of these; z changes slowest, then y, then x, then the turn.
struct PlaceGrid {
  Range x, y, z;  ///< m
  Range turn;     ///< rad

  std::size_t size() const;
  Placement at(std::size_t i) const;
};

struct PlacedPath {
  enum class Outcome {
    kDriven,     ///< in one motion; `objective` is what it reaches
    kNotBetter,  ///< not searched, as its bound is above the best objective
    kNoPose,     ///< some point has no pose that is allowed
    kNoMotion    ///< each looked-at point has, but no motion leads through all
  };
  Placement at;
  Outcome outcome = Outcome::kNotBetter;
  /// What the objective cannot be below by more than kBoundSlack: the largest or the mean of the points'
  /// least costs on the ladder of a degree, each by itself. Infinite of kNoPose.
  double bound = 0;
  double objective = 0;  ///< of kDriven
};

struct PlaceSearch {
  std::vector<PlacedPath> map;      ///< in the order of the grid
  std::optional<std::size_t> best;  ///< the least objective; nothing where no place lets the path be driven
};

/// Relative: by how much a search that refines between the rungs may come below the rungs' bound.
inline constexpr double kBoundSlack = 0.02;

/// The task's path at all places.
PlaceSearch search_places(const Robot& robot, const PathTask& task, const PlaceGrid& grid,
                          const Eigen::Isometry3d& workpiece, int threads, const Progress& progress = {});

}  // namespace stablecut::robot
