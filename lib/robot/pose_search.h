// The stiffest pose over a plane, the redundancy about the tool axis and all branches, and a map of it.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "base/progress.h"
#include "robot/pose_scan.h"

namespace stablecut {

struct FoundPose {
  PlanePoint at;
  JointAngles angles;  ///< controller angles, rad
  double score = 0;    ///< N/m, or m for a deflection
};

/// Poses that are as good as the best.
struct PoseFamily {
  enum class Kind {
    kBaseTurn,  ///< joint 1 may stand anywhere from..to: the whole robot turns about it, tool and plane point
                ///< with it
    kToolTurn,  ///< joint 6 may stand anywhere from..to: it only turns the tool
    kFlippedWrist,  ///< the same tool frame with joints 4 to 6 the other way round: `angles`
    kEqual,         ///< another pose of equal score: `angles`
  };
  Kind kind;
  double from_rad = 0, to_rad = 0;
  JointAngles angles = JointAngles::Zero();
};

struct PoseSearch {
  FoundPose best;
  std::vector<FoundPose>
      alternatives;  ///< other local optima, best first, without members of the best's families
  std::vector<PoseFamily> families;
  bool redundancy_matters = true;
};

/// The scanned points of a task's x and y samples.
struct PlaneScan {
  PoseTask task;
  std::vector<PointScan> points;  ///< y slowest

  const PointScan& at(int x, int y) const { return points[static_cast<std::size_t>(y) * task.x.count + x]; }
};
PlaneScan scan_plane(const Robot& robot, const PoseTask& task, int threads, const Progress& progress = {});

/// The optimum within the task's intervals, wherever the samples lie: a scan at most 50 mm and 5 degrees
/// apart, of 25 points an interval at least and not coarser than the task's samples (`known`, where it is
/// that scan already), then every local optimum refined, with the limits, the singularity margin and the
/// intervals held. Throws NoAnswer when nothing is allowed, saying what stands in the way.
PoseSearch search_poses(const Robot& robot, const PoseTask& task, int most_alternatives, int threads,
                        const Progress& progress = {}, const PlaneScan* known = nullptr);

/// The best of the samples at each point; nothing is refined.
struct PoseMap {
  Eigen::MatrixXd score;                     ///< [y][x], NaN where nothing is allowed
  Eigen::MatrixXd redundancy_rad;            ///< [y][x]
  Eigen::MatrixXi branch;                    ///< [y][x], -1 where nothing is allowed
  std::array<Eigen::MatrixXd, 3> stiffness;  ///< along the tool's x, y, z there, N/m
};
PoseMap pose_map(const Robot& robot, const PlaneScan& scan);

}  // namespace stablecut
