#include "robot/pose_search.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "base/error.h"
#include "robot/search_fixtures_test.h"

using namespace stablecut;
using namespace stablecut::robot;
using namespace stablecut::robot::fixtures;

namespace {

double radius_of(const FoundPose& pose) { return std::hypot(pose.at.x, pose.at.y); }

bool inside(const Range& range, double value) { return value >= range.from && value <= range.to; }

// The pose is what the search says (angles, point, axis, score) and holds intervals, limits and margins.
// Forward and inverse kinematics agree to 1e-11 where the singularity margin is kept.
void check_pose(const Robot& robot, const PoseTask& task, const FoundPose& found) {
  const RobotPose pose = robot_pose(robot, found.angles);
  CHECK((pose.tool.translation() - task.plane.at(found.at.x, found.at.y)).norm() < 1e-11);
  CHECK((pose.tool.linear().col(2) - task.tool_axis).norm() < 1e-11);
  CHECK(std::abs(std::remainder(redundancy_angle(pose.tool) - found.at.redundancy, kTwoPi)) < 1e-9);
  CHECK(limit_margin_rad(robot, found.angles) >= task.limit_margin_rad);
  CHECK(singularity_margin(pose) >= task.singularity_margin);
  CHECK(inside(task.x, found.at.x));
  CHECK(inside(task.y, found.at.y));
  if (!task.full_turn()) CHECK(inside(task.redundancy, found.at.redundancy));
  const Eigen::Matrix3d compliance = translational_compliance(pose, task.elasticity);
  CHECK(stiffness_score(compliance, pose.tool.linear(), task.stiffness) ==
        Approx(found.score).epsilon(1e-10));
}

}  // namespace

TEST_CASE("tool-down optima of the KR360, to 0.1 %, on limits and inside") {
  // Independent code: 197.3 um and A2 at its limit for every index at 1.6 m; at 1.2 m as in the rows, where
  // it gives 6.37e6 near A3's limit for `combined`: on the limit it is 6.381e6, as brute force confirms.
  struct Case {
    double height;
    const char* index;
    double score, radius, joint2_deg, joint3_deg;  // NaN: not stated
  };
  constexpr double kFree = std::numeric_limits<double>::quiet_NaN();
  const Robot robot = kr360();
  for (const Case& c :
       {Case{1.6, "deflection", 197.3e-6, 0.689, -130, kFree},
        Case{1.6, "combined", kFree, 0.689, -130, kFree}, Case{1.6, "weakest", kFree, 0.689, -130, kFree},
        Case{1.6, "axial", kFree, 0.689, -130, kFree},
        Case{1.2, "deflection", 211.1e-6, 0.898, -110.8, kFree},
        Case{1.2, "weakest", 1.543e6, 0.773, kFree, 144}, Case{1.2, "axial", 2.788e6, 0.898, kFree, kFree},
        Case{1.2, "combined", 6.381e6, 0.773, kFree, 144}}) {
    const PoseTask task = tool_down(robot, c.height, c.index, 0);
    const PoseSearch search = search_poses(robot, task, 5, 1);
    INFO("height " << c.height << ", index " << c.index << ", score " << search.best.score);
    check_pose(robot, task, search.best);
    if (!std::isnan(c.score)) CHECK(search.best.score == Approx(c.score).epsilon(1e-3));
    CHECK(radius_of(search.best) == Approx(c.radius).margin(0.001));
    if (!std::isnan(c.joint2_deg))
      CHECK(degrees_from_radians(search.best.angles[1]) == Approx(c.joint2_deg).margin(0.1));
    if (!std::isnan(c.joint3_deg))
      CHECK(std::abs(degrees_from_radians(search.best.angles[2]) - c.joint3_deg) < 1e-6);
    CHECK(has_family(search, PoseFamily::Kind::kBaseTurn));
    CHECK(has_family(search, PoseFamily::Kind::kFlippedWrist));
    CHECK(search.redundancy_matters == (c.index == std::string("combined")));
    CHECK(has_family(search, PoseFamily::Kind::kToolTurn) == !search.redundancy_matters);
    // The other elbow or the shoulder over the back reaches the plane too, with an optimum of its own.
    CHECK_FALSE(search.alternatives.empty());
    for (const FoundPose& other : search.alternatives) {
      check_pose(robot, task, other);
      CHECK((task.stiffness.index->larger_is_better ? other.score < search.best.score
                                                    : other.score > search.best.score));
    }
  }
}

TEST_CASE("a load that is not vertical breaks the circle into a mirrored pair") {
  const Robot robot = kr360();
  PoseTask task = tool_down(robot, 1.6, "deflection", 0);
  task.stiffness.force_n = Eigen::Vector3d(400, 0, -400);
  for (const int count : {64, 7, 2}) {  // whatever the user's samples are
    task.x.count = task.y.count = count;
    const PoseSearch search = search_poses(robot, task, 5, 1);
    check_pose(robot, task, search.best);
    CHECK(search.best.score == Approx(117.5e-6).epsilon(1e-3));
    CHECK(search.best.at.x == Approx(0.592).margin(0.002));
    CHECK(std::abs(search.best.at.y) == Approx(0.353).margin(0.002));
    CHECK_FALSE(has_family(search, PoseFamily::Kind::kBaseTurn));
    REQUIRE(has_family(search, PoseFamily::Kind::kEqual));
    for (const PoseFamily& family : search.families) {
      if (family.kind != PoseFamily::Kind::kEqual) continue;
      CHECK(robot_pose(robot, family.angles).tool.translation().y() ==
            Approx(-search.best.at.y).margin(1e-4));
    }
  }
}

TEST_CASE("the limit margin is kept, and the optimum lies on it") {
  const Robot robot = kr360();
  const PoseTask task = tool_down(robot, 1.6, "deflection", 5);
  const PoseSearch search = search_poses(robot, task, 0, 1);
  check_pose(robot, task, search.best);
  CHECK(std::abs(degrees_from_radians(search.best.angles[1]) + 125) < 1e-6);
  CHECK(search.alternatives.empty());
}

TEST_CASE("the flipped wrist is the same tool frame, and listed only where the limits allow it") {
  Robot robot = kr360();
  const PoseTask task = tool_down(robot, 1.6, "weakest", 2);
  const PoseSearch search = search_poses(robot, task, 0, 2);
  REQUIRE(has_family(search, PoseFamily::Kind::kFlippedWrist));
  for (const PoseFamily& family : search.families) {
    if (family.kind != PoseFamily::Kind::kFlippedWrist) continue;
    CHECK(limit_margin_rad(robot, family.angles) >= task.limit_margin_rad);
    CHECK(family.angles[4] == Approx(-search.best.angles[4]).epsilon(1e-9));
    CHECK(
        (robot_pose(robot, family.angles).tool.matrix() - robot_pose(robot, search.best.angles).tool.matrix())
            .norm() < 1e-11);
  }
  // A wrist that bends one way only.
  robot.joints[4].max_rad = 0;
  const PoseSearch one_way = search_poses(robot, task, 0, 2);
  check_pose(robot, task, one_way.best);
  CHECK(one_way.best.score == Approx(search.best.score).epsilon(1e-6));
  CHECK_FALSE(has_family(one_way, PoseFamily::Kind::kFlippedWrist));
}

TEST_CASE("an offset tool: the redundancy angle matters by what brute force says") {
  const Robot robot = with_tool_offset(kr360(), 0.2);
  PoseTask task = tool_down(robot, 1.6, "weakest", 2);
  task.x = {1.5, 1.5, 1};
  task.y = {0.3, 0.3, 1};
  double best = 0, worst = 1e99;
  const InverseKinematics inverse(robot);
  for (int i = 0; i < 3600; ++i) {
    double best_here = 0;
    const double turn = kTwoPi * i / 3600;
    for (const auto& solution : inverse.solve(tool_frame({1.5, 0.3, 1.6}, -Eigen::Vector3d::UnitZ(), turn))) {
      const RobotPose pose = robot_pose(robot, solution.angles);
      if (solution.limit_margin_rad < task.limit_margin_rad || singularity_margin(pose) < 0.01) continue;
      best_here =
          std::max(best_here, 1 / principal_compliances(translational_compliance(pose, task.elasticity))[0]);
    }
    best = std::max(best, best_here);
    if (best_here > 0) worst = std::min(worst, best_here);
  }
  const PoseSearch search = search_poses(robot, task, 5, 1);
  CHECK(search.redundancy_matters);
  CHECK(search.best.score == Approx(best).epsilon(1e-4));
  CHECK(search.best.score >= best * (1 - 1e-9));
  CHECK(best / worst > 1.2);
  for (const double turn : {-2.0, 0.0, 1.0}) {
    PoseTask fixed = task;
    fixed.redundancy = {turn, turn, 1};
    CHECK(search_poses(robot, fixed, 0, 1).best.score <= search.best.score);
  }
}

TEST_CASE("random tasks: the search is never beaten by random poses", "[campaign]") {
  std::mt19937_64 generator(11);
  for (int n = 0; n < 12; ++n) {
    Robot robot = with_tool_offset(kr360(), n % 2 == 0 ? 0 : uniform(generator, 0.05, 0.3));
    if (n % 3 == 0) {
      robot.tool.linear() =
          Eigen::AngleAxisd(uniform(generator, -1.5, 1.5), Eigen::Vector3d::UnitY()).matrix();
    }
    PoseTask task = tool_down(robot, uniform(generator, 0.5, 2.2),
                              stiffness_indices()[n % stiffness_indices().size()].name, 2);
    task.stiffness.force_n = Eigen::Vector3d(uniform(generator, -500, 500), uniform(generator, -500, 500),
                                             uniform(generator, -500, 500));
    task.stiffness.force_in_tool = n % 5 == 0;
    if (task.stiffness.index->needs_cut) with_cut(task.stiffness, generator);
    if (n % 3 == 1)
      task.tool_axis = Eigen::Vector3d(uniform(generator, -1, 1), uniform(generator, -1, 1), -1).normalized();
    if (n % 4 == 3) task.redundancy = {-0.5, 1, 5};
    task.x.count = task.y.count = 5;
    const PoseSearch search = search_poses(robot, task, 5, 2);
    INFO("task " << n << ", score " << search.best.score);
    check_pose(robot, task, search.best);
    check_not_beaten(robot, task, search.best, 20000, generator);
  }
}

TEST_CASE(
    "random windows and points, also out of reach: an allowed pose that random poses do not beat, or none",
    "[campaign]") {
  std::mt19937_64 generator(23);
  int found = 0, none = 0;
  for (int n = 0; n < 60; ++n) {
    const Robot robot = n % 3 == 0 ? with_tool_offset(kr360(), uniform(generator, 0, 0.3))
                                   : random_robot(static_cast<unsigned>(n) % 12);
    INFO("task " << n);
    PoseTask task = tool_down(kr360(), 1, stiffness_indices()[n % stiffness_indices().size()].name, 2);
    task.plane.origin = robot.base.translation() + Eigen::Vector3d(0, 0, uniform(generator, -0.5, 1.5));
    if (task.stiffness.index->needs_cut) with_cut(task.stiffness, generator);
    const double size = n % 4 == 0 ? 0 : n % 4 == 1 ? 0.01 : uniform(generator, 0.1, 1);
    const auto window = [&](double at) { return Range{at, at + size, size > 0 ? 5 : 1}; };
    task.x = window(uniform(generator, -2, 1.5)), task.y = window(uniform(generator, -2, 1.5));
    if (n % 5 == 0) task.redundancy = {0.3, 0.3, 1};
    std::optional<PoseSearch> search;
    try {
      search = search_poses(robot, task, 5, 1);
    } catch (const NoPose&) {
      ++none;
      continue;
    }
    ++found;
    check_pose(robot, task, search->best);
    for (const FoundPose& other : search->alternatives) check_pose(robot, task, other);
    const PoseScanner scanner(robot, task);
    const double sense = task.stiffness.index->larger_is_better ? 1 : -1;
    for (int i = 0; i < 2000; ++i) {
      const double turn = task.redundancy.is_point() ? task.redundancy.from : uniform(generator, -kPi, kPi);
      const PlanePoint at{uniform(generator, task.x.from, task.x.to),
                          uniform(generator, task.y.from, task.y.to), turn, i % kBranches};
      const auto pose = scanner.evaluate(at);
      if (!pose || limit_margin_rad(robot, pose->angles) < task.limit_margin_rad ||
          !is_away_from_singularities(robot_pose(robot, pose->angles), task.singularity_margin))
        continue;
      CHECK(sense * search->best.score >= sense * pose->score - 1e-6 * std::abs(pose->score));
    }
  }
  CHECK(found > 20);
  CHECK(none > 5);
}

TEST_CASE("straight down at 1.6 m the plane is reached from 0.689 m in front to 2.5735 m") {
  const Robot robot = kr360();
  PoseTask task = tool_down(robot, 1.6, "axial", 0);
  task.singularity_margin = 0;
  task.x = {0, 2.7, 2701};
  task.y = {0, 0, 1};
  const PlaneScan scan = scan_plane(robot, task, 2);
  const PoseMap map = pose_map(robot, scan);
  double nearest = 9, nearest_in_front = 9, farthest = 0;
  for (int i = 0; i < task.x.count; ++i) {
    if (map.branch(0, i) < 0) continue;
    CHECK(std::isfinite(map.score(0, i)));
    CHECK(map.stiffness[2](0, i) == Approx(map.score(0, i)).epsilon(1e-12));
    nearest = std::min(nearest, task.x.at(i));
    if (scan.at(i, 0).arms[0] || scan.at(i, 0).arms[1])
      nearest_in_front = std::min(nearest_in_front, task.x.at(i));
    farthest = std::max(farthest, task.x.at(i));
  }
  // Stretched, the wrist centre 0.5 m above the plane: exact.
  const double arm = 1.3 + std::hypot(1.025, 0.055), rise = 1.6 + 0.5 - 1.045;
  const double outer = 0.5 + std::sqrt(arm * arm - rise * rise);
  CHECK(outer == Approx(2.5735).margin(1e-4));
  CHECK(farthest <= outer);
  CHECK(farthest > outer - 0.0011);
  CHECK(nearest_in_front == Approx(0.689).margin(0.0011));
  // Reaching over its back the robot comes nearer.
  CHECK(nearest == Approx(0.644).margin(0.0011));
}

TEST_CASE("a map does not depend on the number of threads, and the search is not below it") {
  const Robot robot = with_tool_offset(kr360(), 0.15);
  PoseTask task = tool_down(robot, 1.3, "combined", 2);
  task.x.count = task.y.count = 25;
  const PoseMap one = pose_map(robot, scan_plane(robot, task, 1)),
                two = pose_map(robot, scan_plane(robot, task, 2));
  CHECK(one.branch == two.branch);
  double best = 0;
  int reached = 0;
  for (Eigen::Index k = 0; k < one.score.size(); ++k) {
    if (one.branch.data()[k] < 0) continue;
    CHECK(one.score.data()[k] == two.score.data()[k]);
    best = std::max(best, one.score.data()[k]);
    ++reached;
  }
  CHECK(reached > 300);  // of 625
  CHECK(search_poses(robot, task, 5, 2).best.score >= best);
}

TEST_CASE("intervals are held, however coarse or large") {
  const Robot robot = with_tool_offset(kr360(), 0.2);
  PoseTask task = tool_down(robot, 1.6, "weakest", 2);
  const double whole = search_poses(robot, task, 0, 2).best.score;
  // Half a turn in two samples is not the full turn.
  task.redundancy = {0, kPi, 2};
  task.x = {1.2, 1.6, 3};
  task.y = {-0.5, -0.1, 2};
  const FoundPose half = search_poses(robot, task, 0, 2).best;
  CHECK(half.at.redundancy >= 0);
  CHECK(half.at.redundancy <= kPi);
  // A plane far larger than the robot.
  task = tool_down(robot, 1.6, "weakest", 2);
  task.x = task.y = {-1e9, 1e9, 3};
  CHECK(search_poses(robot, task, 0, 2).best.score == Approx(whole).epsilon(1e-6));
}

TEST_CASE("a fixed redundancy with a coaxial tool: joint 6 makes up for the base's turn") {
  const Robot robot = kr360();
  PoseTask task = tool_down(robot, 1.6, "weakest", 2);
  task.redundancy = {0.4, 0.4, 1};
  const PoseSearch search = search_poses(robot, task, 5, 2);
  check_pose(robot, task, search.best);
  CHECK(search.best.at.redundancy == 0.4);
  REQUIRE(has_family(search, PoseFamily::Kind::kBaseTurn));
  for (const PoseFamily& family : search.families) {
    if (family.kind == PoseFamily::Kind::kBaseTurn)
      CHECK(family.to_rad - family.from_rad > radians_from_degrees(340));
  }
}

TEST_CASE("a thrust along a coaxial tool does not feel its turn, a force across it does") {
  const Robot robot = kr360();
  PoseTask task = tool_down(robot, 1.6, "deflection", 2);
  task.stiffness.force_in_tool = true;
  task.stiffness.force_n = Eigen::Vector3d(0, 0, 500);
  CHECK_FALSE(search_poses(robot, task, 0, 2).redundancy_matters);
  task.stiffness.force_n = Eigen::Vector3d(100, 0, 500);
  CHECK(search_poses(robot, task, 0, 2).redundancy_matters);
}

TEST_CASE("no pose, and why") {
  const Robot robot = kr360();
  const auto obstacle = [&](const PoseTask& task) {
    try {
      search_poses(robot, task, 5, 1);
    } catch (const NoPose& none) {
      return none.obstacle();
    }
    FAIL("a pose was found");
    return Obstacle{};
  };
  PoseTask task = tool_down(robot, 1.6, "combined", 2);
  task.x = {3, 3.2, 5};
  CHECK(obstacle(task).kind == Obstacle::Kind::kOutOfReach);
  task.x = {0, 0.3, 5};
  task.y = {-0.1, 0.1, 3};
  const Obstacle limit = obstacle(task);
  CHECK(limit.kind == Obstacle::Kind::kJointLimit);
  // The least violation by brute force, on the grid that the search makes of such short intervals.
  double least = -9;
  int joint = -1;
  const InverseKinematics inverse(robot);
  for (const double x : Range{0, 0.3, 25}.values()) {
    for (const double y : Range{-0.1, 0.1, 25}.values()) {
      for (const double turn : task.redundancy.values()) {
        for (const auto& s : inverse.solve(tool_frame(task.plane.at(x, y), task.tool_axis, turn))) {
          if (s.limit_margin_rad <= least) continue;
          least = s.limit_margin_rad;
          for (int j = 0; j < kJoints; ++j) {
            if (robot.range(j, s.angles).margin_rad(s.angles[j]) == least) joint = j;
          }
        }
      }
    }
  }
  CHECK(least < 0);
  CHECK(limit.joint == joint);
  CHECK(std::abs(limit.margin_rad - least) < 1e-9);
  task = tool_down(robot, 1.6, "combined", 2);
  task.singularity_margin = 0.9;
  CHECK(obstacle(task).kind == Obstacle::Kind::kSingularity);
  CHECK_THROWS_AS(plane_reach(robot, {{0, 0, 9}, {1, 0, 0}, {0, 1, 0}}, task.tool_axis), NoPose);
  task.stiffness = {};
  task.stiffness.index = &stiffness_index("deflection");
  CHECK_THROWS_AS(search_poses(robot, task, 5, 1), InvalidArgument);
}
