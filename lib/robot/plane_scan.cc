#include "robot/plane_scan.h"

#include <limits>

#include "base/parallel.h"

namespace stablecut::robot {

PlaneScan scan_plane(const Robot& robot, const PoseTask& task, int threads, const Progress& progress) {
  PlaneScan scan{task, {}};
  scan.points.resize(static_cast<std::size_t>(task.x.count) * task.y.count);
  const PoseScanner scanner(robot, task);
  parallel_for(
      static_cast<std::size_t>(task.y.count), threads,
      [&](std::size_t j) {
        for (int i = 0; i < task.x.count; ++i) {
          scan.points[j * task.x.count + i] = scanner.scan(task.x.at(i), task.y.at(static_cast<int>(j)));
        }
      },
      progress);
  return scan;
}

RedundancySweep redundancy_sweep(const Robot& robot, const PoseTask& task, double x, double y) {
  RedundancySweep sweep;
  PoseTask one = task;
  for (int i = 0; i < task.redundancy.count; ++i) {
    one.redundancy = {task.redundancy.at(i), task.redundancy.at(i), 1};
    const PoseScanner scanner(robot, one);
    const auto best = scanner.scan(x, y).best();
    sweep.redundancy_rad.push_back(one.redundancy.from);
    sweep.score.push_back(best ? std::optional(scanner.evaluate(best->at)->score) : std::nullopt);
  }
  return sweep;
}

PoseMap pose_map(const Robot& robot, const PlaneScan& scan) {
  const PoseScanner scanner(robot, scan.task);
  const Eigen::Index rows = scan.task.y.count, columns = scan.task.x.count;
  constexpr double kNowhere = std::numeric_limits<double>::quiet_NaN();
  PoseMap map{Eigen::MatrixXd::Constant(rows, columns, kNowhere),
              Eigen::MatrixXd::Constant(rows, columns, kNowhere),
              Eigen::MatrixXi::Constant(rows, columns, -1),
              {}};
  map.stiffness.fill(map.score);
  for (Eigen::Index j = 0; j < rows; ++j) {
    for (Eigen::Index i = 0; i < columns; ++i) {
      const auto best = scan.at(static_cast<int>(i), static_cast<int>(j)).best();
      if (!best) continue;
      const auto evaluation = scanner.evaluate(best->at);
      map.score(j, i) = evaluation->score;
      map.redundancy_rad(j, i) = best->at.redundancy;
      map.branch(j, i) = best->at.branch;
      for (int d = 0; d < 3; ++d) {
        map.stiffness[d](j, i) =
            directional_stiffness(evaluation->compliance, evaluation->tool.linear().col(d));
      }
    }
  }
  return map;
}

}  // namespace stablecut::robot
