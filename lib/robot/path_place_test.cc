// The best place of a workpiece against full searches of the path at every place.
#include "robot/path_place.h"

#include <catch2/catch.hpp>

#include "robot/path_fixtures_test.h"

namespace stablecut::robot {
namespace {

using namespace fixtures;

Eigen::Isometry3d frame_at(const Eigen::Vector3d& origin) {
  Eigen::Isometry3d frame(Eigen::AngleAxisd(0.4, Eigen::Vector3d(1, 2, 5).normalized()));
  frame.translation() = origin;
  return frame;
}

TEST_CASE("the best place is that of a full search at every place", "[campaign]") {
  PathCell cell = path_cells()[GENERATE(0, 2)];
  cell.robot = with_tool_offset(cell.robot, 0.15);
  const bool mean = GENERATE(false, true);
  const std::string_view index = mean ? "deflection" : "weakest";
  CAPTURE(cell.name, mean);
  PathTask task = path_task(cell, zigzag_path(cell, 24, 0.2), index);
  task.mean_objective = mean;
  const Eigen::Isometry3d workpiece = frame_at(cell.workpiece);
  // Out to where the arm does not reach.
  const PlaceGrid grid{{-0.2, 1.2, 4}, {-0.6, 0.3, 3}, {0, 0.3, 2}, {-0.5, 0.5, 3}};
  REQUIRE(grid.size() == 72);
  const PlaceSearch search = search_places(cell.robot, task, grid, workpiece, 2);
  REQUIRE(search.map.size() == 72);
  REQUIRE(search.best);
  double best = kUnreached;
  int spared = 0, out = 0;
  for (std::size_t i = 0; i < search.map.size(); ++i) {
    const PlacedPath& place = search.map[i];
    PathTask there = task;
    there.path = placed(task.path, place.at, workpiece);
    const PathModel model(cell.robot, there);
    const PathSearch full = search_path(model, 2);
    const bool driven = full.obstacles.empty();
    spared += place.outcome == PlacedPath::Outcome::kNotBetter;
    out += !driven;
    switch (place.outcome) {
      case PlacedPath::Outcome::kDriven:
        REQUIRE(driven);
        CHECK(place.objective == full.parts[0].objective);
        break;
      case PlacedPath::Outcome::kNotBetter:
        break;
      case PlacedPath::Outcome::kNoPose:
      case PlacedPath::Outcome::kNoMotion:
        CHECK(!driven);
        break;
    }
    if (!driven) continue;
    // The points by themselves are not worse than together, the refinement between the rungs apart.
    CHECK(full.parts[0].objective >= place.bound * (1 - kBoundSlack));
    best = std::min(best, full.parts[0].objective);
  }
  CHECK(search.map[*search.best].objective == best);
  CHECK(spared > 10);
  CHECK(out > 5);
}

TEST_CASE("a workpiece is moved, and turned about the vertical through its frame's origin") {
  const Eigen::Isometry3d workpiece = frame_at({1, 0.5, 0.2});
  const Placement placement{{0.1, -0.2, 0.3}, kPi / 2};
  // Points by their coordinates in the workpiece.
  const Eigen::Vector3d in_workpiece(0.3, -0.1, 0.25);
  const ToolPath path{{workpiece * in_workpiece, workpiece.linear() * -Eigen::Vector3d::UnitZ(),
                       workpiece.linear() * Eigen::Vector3d::UnitX(), 0.1}};
  const ToolPath there = placed(path, placement, workpiece);
  const Eigen::Vector3d arm = path[0].position - workpiece.translation();
  CHECK((there[0].position - Eigen::Vector3d(1.1 - arm.y(), 0.3 + arm.x(), 0.5 + arm.z())).norm() < 1e-14);
  CHECK((there[0].position - placement.frame(workpiece) * in_workpiece).norm() < 1e-14);
  CHECK((there[0].axis - Eigen::Vector3d(-path[0].axis.y(), path[0].axis.x(), path[0].axis.z())).norm() <
        1e-14);
  CHECK((*there[0].feed - Eigen::Vector3d(-path[0].feed->y(), path[0].feed->x(), path[0].feed->z())).norm() <
        1e-14);
  CHECK(there[0].speed == 0.1);
}

}  // namespace
}  // namespace stablecut::robot
