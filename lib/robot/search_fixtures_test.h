// What the tests of searches share.
#pragma once

#include <algorithm>
#include <catch2/catch.hpp>

#include "robot/inverse.h"
#include "robot/pose_search.h"
#include "robot/robot_fixtures_test.h"

namespace stablecut::robot::fixtures {

inline bool has_family(const PoseSearch& search, PoseFamily::Kind kind) {
  return std::any_of(search.families.begin(), search.families.end(),
                     [&](const auto& f) { return f.kind == kind; });
}

/// No allowed pose of some draws, half of them near the pose found, has a better score than it by more than
/// 1e-6.
inline void check_not_beaten(const Robot& robot, const PoseTask& task, const FoundPose& found, int draws,
                             std::mt19937_64& generator) {
  const InverseKinematics inverse(robot);
  const bool larger = task.stiffness.index->larger_is_better;
  double best = larger ? 0 : 1e9;
  int tried = 0;
  for (int i = 0; i < draws; ++i) {
    const auto draw = [&](const Range& range, double at) {
      const double value = i % 2 == 0 ? uniform(generator, range.from, range.to)
                                      : at + 0.02 * numerics::unit_normal(generator);
      return std::clamp(value, range.from, range.to);
    };
    const double x = draw(task.x, found.at.x), y = draw(task.y, found.at.y);
    const double turn = draw(task.redundancy, found.at.redundancy);
    for (const auto& solution : inverse.solve(tool_frame(task.plane.at(x, y), task.tool_axis, turn))) {
      if (solution.limit_margin_rad < task.limit_margin_rad) continue;
      const RobotPose pose = robot_pose(robot, solution.angles);
      if (singularity_margin(pose) < task.singularity_margin) continue;
      const double score = stiffness_score(translational_compliance(pose, task.elasticity),
                                           pose.tool.linear(), task.stiffness);
      best = larger ? std::max(best, score) : std::min(best, score);
      ++tried;
    }
  }
  CHECK(tried > draws / 20);
  if (larger)
    CHECK(found.score >= best * (1 - 1e-6));
  else
    CHECK(found.score <= best * (1 + 1e-6));
}

}  // namespace stablecut::robot::fixtures
