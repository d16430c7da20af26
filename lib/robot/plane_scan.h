// A task's plane scanned point by point, and the map of the best samples.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "base/progress.h"
#include "robot/pose_scan.h"

namespace stablecut::robot {

/// The scanned points of a task's x and y samples.
struct PlaneScan {
  PoseTask task;
  std::vector<PointScan> points;  ///< y slowest

  const PointScan& at(int x, int y) const { return points[static_cast<std::size_t>(y) * task.x.count + x]; }
};
PlaneScan scan_plane(const Robot& robot, const PoseTask& task, int threads, const Progress& progress = {});

/// The score at a point (m, in the plane) over the task's redundancy samples, of the best branch at each;
/// nothing where no branch is allowed.
struct RedundancySweep {
  std::vector<double> redundancy_rad;
  std::vector<std::optional<double>> score;  ///< SI units
};
RedundancySweep redundancy_sweep(const Robot& robot, const PoseTask& task, double x, double y);

/// The best sample at each point of the plane, without refinement.
struct PoseMap {
  Eigen::MatrixXd score;                     ///< [y][x], NaN where nothing is allowed
  Eigen::MatrixXd redundancy_rad;            ///< [y][x]
  Eigen::MatrixXi branch;                    ///< [y][x], -1 where nothing is allowed
  std::array<Eigen::MatrixXd, 3> stiffness;  ///< along the tool's x, y, z there, N/m
};
PoseMap pose_map(const Robot& robot, const PlaneScan& scan);

}  // namespace stablecut::robot
