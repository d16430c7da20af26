// An independent dynamic programme over redundancy angles of whole degrees, from the room's plain functions
// and without any of the path search's devices: what a path search must not be worse than.
#pragma once

#include "base/units.h"
#include "robot/inverse.h"
#include "robot/keep_out.h"
#include "robot/path_task.h"

namespace stablecut::robot::fixtures {

struct BruteNode {
  JointAngles angles;
  int branch, degree;
  double cost, value;
};

inline std::vector<BruteNode> brute_nodes(const Robot& robot, const PathTask& task, const PathFrames& frames,
                                          std::size_t point) {
  const InverseKinematics inverse(robot);
  const StiffnessTask at = point_task(task, frames, point);
  std::vector<BruteNode> nodes;
  for (int degree = -180; degree < 180; ++degree) {
    const Eigen::Isometry3d tool =
        tool_frame(task.path[point].position, task.path[point].axis, radians_from_degrees(degree));
    for (const InverseSolution& solution : inverse.solve(tool)) {
      if (solution.limit_margin_rad < task.limit_margin_rad) continue;
      const RobotPose pose = robot_pose(robot, solution.angles);
      if (!is_away_from_singularities(pose, task.singularity_margin) || keep_out_margin_m(robot, pose) < 0)
        continue;
      const double score =
          stiffness_score(translational_compliance(pose, task.elasticity), tool.linear(), at);
      const double cost = path_cost(*at.index, score);
      for (const JointAngles& copy : copies_within_limits(robot, solution.angles, task.limit_margin_rad))
        nodes.push_back({copy, solution.branch, degree, cost, cost});
    }
  }
  return nodes;
}

/// The least largest cost, or the least mean; infinite where nothing leads through. Steps of the redundancy
/// of more than `window` degrees are not looked at.
inline double brute_force_objective(const Robot& robot, const PathTask& task, int window) {
  const PathFrames frames = path_frames(task.path);
  std::vector<BruteNode> before;
  for (std::size_t i = 0; i < task.path.size(); ++i) {
    std::vector<BruteNode> now = brute_nodes(robot, task, frames, i);
    if (i > 0) {
      std::array<std::vector<const BruteNode*>, 360> by_degree;
      for (const BruteNode& node : before) by_degree[node.degree + 180].push_back(&node);
      const JointAngles limit = (task.max_speed * frames.time[i]).cwiseMin(kPi / 2);
      for (BruteNode& node : now) {
        double best = std::numeric_limits<double>::infinity();
        for (int d = -window; d <= window; ++d) {
          for (const BruteNode* from : by_degree[(node.degree + d + 540) % 360]) {
            if (from->value < best && from->branch == node.branch &&
                ((node.angles - from->angles).cwiseAbs().array() <= limit.array()).all())
              best = from->value;
          }
        }
        node.value = task.mean_objective ? best + node.cost : std::max(best, node.cost);
      }
    }
    std::erase_if(now, [](const BruteNode& node) { return !std::isfinite(node.value); });
    before = std::move(now);
  }
  double best = std::numeric_limits<double>::infinity();
  for (const BruteNode& node : before) best = std::min(best, node.value);
  return task.mean_objective ? best / static_cast<double>(task.path.size()) : best;
}

}  // namespace stablecut::robot::fixtures
