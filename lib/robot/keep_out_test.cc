#include "robot/keep_out.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "robot/pose_standing.h"
#include "robot/robot_fixtures_test.h"

using namespace stablecut;
using namespace stablecut::robot;
using namespace stablecut::robot::fixtures;

namespace {

// A robot whose only capsule is one of link `j`.
Robot with_capsule(Robot robot, int j, const Capsule& capsule) {
  robot.joints[static_cast<std::size_t>(j)].capsules = {capsule};
  return robot;
}

double outside(const Eigen::Vector3d& point, const Box& box) {
  const double distance = (point - point.cwiseMax(box.least_m).cwiseMin(box.most_m)).norm();
  const double depth = std::min((point - box.least_m).minCoeff(), (box.most_m - point).minCoeff());
  return distance > 0 ? distance : -depth;
}

}  // namespace

TEST_CASE("distances of tool and capsules to a box, the floor and the column by points on them") {
  std::mt19937_64 generator(41);
  const auto point = [&](double size) {
    return Eigen::Vector3d(uniform(generator, -size, size), uniform(generator, -size, size),
                           uniform(generator, -size, size));
  };
  for (int n = 0; n < 200; ++n) {
    Robot robot = n % 2 ? random_robot(static_cast<unsigned>(n)) : kr360();
    const int link = n % 6;
    const Capsule capsule{point(0.5), point(0.5), uniform(generator, 0.05, 0.2)};
    robot = with_capsule(robot, link, capsule);
    const Eigen::Vector3d centre = point(2), half = point(1).cwiseAbs();
    if (n % 3 == 0) robot.keep_out_boxes = {{centre - half, centre + half}};
    if (n % 3 == 1) robot.floor_m = uniform(generator, -1, 1);
    if (n % 3 == 2) robot.keep_out_radius_m = uniform(generator, 0.1, 0.8);
    const JointAngles angles = random_angles(robot, generator);
    const RobotPose pose = robot_pose(robot, angles);
    // The link's frame from a robot that ends there.
    Eigen::Isometry3d frame = robot.base;
    const JointAngles turns = joint_turns(robot, angles);
    for (int j = 0; j <= link; ++j) {
      const Joint& joint = robot.joints[static_cast<std::size_t>(j)];
      frame =
          frame * Eigen::AngleAxisd(joint.alpha_rad(), Eigen::Vector3d::UnitX()) *
          Eigen::Translation3d(joint.a_m, 0, 0) *
          Eigen::AngleAxisd(joint.theta_sign * turns[j] + joint.theta_offset_rad, Eigen::Vector3d::UnitZ()) *
          Eigen::Translation3d(0, 0, joint.d_m);
    }
    double least = std::numeric_limits<double>::infinity();
    const auto look = [&](const Eigen::Vector3d& at, double radius, bool column) {
      if (!robot.keep_out_boxes.empty())
        least = std::min(least, outside(at, robot.keep_out_boxes[0]) - radius);
      if (robot.floor_m) least = std::min(least, at.z() - *robot.floor_m - radius);
      if (robot.keep_out_radius_m > 0 && column) {
        const Eigen::Vector3d from = at - pose.point.col(0);
        least = std::min(least, from.cross(pose.axis.col(0)).norm() - robot.keep_out_radius_m - radius);
      }
    };
    constexpr int kPoints = 2000;
    for (int i = 0; i <= kPoints; ++i) {
      const double t = static_cast<double>(i) / kPoints;
      look(pose.flange.translation() + t * (pose.tool.translation() - pose.flange.translation()), 0, true);
      if (link > 0)
        look(frame * (capsule.from_m + t * (capsule.to_m - capsule.from_m)), capsule.radius_m, link > 1);
    }
    // Points half a step off, 5e-4 m of at most 2 m, miss the least by less than that.
    INFO("run " << n);
    CHECK(keep_out_margin_m(robot, pose) <= least + 1e-9);
    CHECK(keep_out_margin_m(robot, pose) >= least - 5e-4);
  }
  CHECK(std::isinf(keep_out_margin_m(kr360(), robot_pose(kr360(), JointAngles::Zero()))));
}

TEST_CASE("the column reaches axis 2, and what its capsules sweep") {
  CHECK(column_radius_m(kr360()) == Approx(0.5));
  // Of link 1: the farther end and the radius, whatever the height.
  CHECK(column_radius_m(with_capsule(kr360(), 0, {{0.3, 0.4, 7}, {0, 0, 0}, 0.2})) == Approx(0.7));
  CHECK(column_radius_m(with_capsule(kr360(), 0, {{0.1, 0, 0}, {0, 0, 0}, 0.2})) == Approx(0.5));
  Robot robot = kr360();
  robot.base_capsules = {{{0.6, 0.8, 0}, {0, 0, 0}, 0.1}};
  CHECK(column_radius_m(robot) == Approx(1.1));
}

TEST_CASE("a box on the best place moves it, and the answer says that it stands on the box") {
  Robot robot = kr360();
  PoseTask task = tool_down(robot, 1.2, "axial", 2);
  task.x = {0, 2.5, 26};
  task.y = {0, 0, 1};
  const PoseSearch open = search_poses(robot, task, 5, 1);
  robot.keep_out_boxes = {
      {open.best.at.x < 0 ? Eigen::Vector3d(-9, -9, -9) : Eigen::Vector3d(open.best.at.x - 0.2, -0.1, 0),
       Eigen::Vector3d(open.best.at.x + 0.2, 0.1, 1.3)}};
  const PoseSearch moved = search_poses(robot, task, 5, 1);
  CHECK(moved.best.score < open.best.score);
  const RobotPose pose = robot_pose(robot, moved.best.angles);
  CHECK(keep_out_margin_m(robot, pose) >= 0);
  const PoseReport report = report_pose(robot, moved.best.angles, task.stiffness, task.elasticity, {});
  const Standing standing = standing_of(task, report, moved.best.at);
  CHECK(standing.keep_out);
  CHECK_FALSE(standing.singularity);
  CHECK_FALSE(standing.x);
  // No pose of a map or among the alternatives is inside.
  const PlaneScan scan = scan_plane(robot, task, 1);
  const PoseScanner scanner(robot, task);
  int points = 0;
  for (const PointScan& point : scan.points) {
    for (const auto& arm : point.arms) {
      if (!arm) continue;
      ++points;
      CHECK(keep_out_margin_m(robot, robot_pose(robot, scanner.evaluate(arm->at)->angles)) >= 0);
    }
  }
  CHECK(points > 5);
  // A box that leaves nothing is what the search says.
  robot.keep_out_boxes = {{Eigen::Vector3d(-9, -9, 1.1), Eigen::Vector3d(9, 9, 1.3)}};
  try {
    search_poses(robot, task, 5, 1);
    FAIL("found a pose");
  } catch (const NoPose& none) {
    CHECK(none.obstacle().kind == Obstacle::Kind::kKeepOut);
  }
}

TEST_CASE("moving and turning the part: what a search at the place moved to finds") {
  const Robot robot = with_tool_offset(kr360(), 0.15);
  PoseTask task = tool_down(robot, 1.4, "deflection", 2);
  task.stiffness.force_n = Eigen::Vector3d(200, 100, -400);
  FoundPose found;
  found.at = {1.6, 0.4, 0, 0};
  const std::vector<PartMove> moves = part_moves(robot, task, found);
  REQUIRE(moves.size() == 12);
  for (const PartMove& move : moves) {
    if (move.turn || move.axis == 2) continue;
    PoseTask there = task;
    const double x = 1.6 + (move.axis == 0 ? move.amount : 0), y = 0.4 + (move.axis == 1 ? move.amount : 0);
    there.x = {x, x, 1};
    there.y = {y, y, 1};
    CHECK(*move.score == Approx(search_poses(robot, there, 0, 1).best.score).epsilon(1e-6));
  }
  // Turned about axis 1, all the same: the part 0.05 m on by a turn of the base, and about the normal.
  PoseTask turned = task;
  turned.stiffness.force_n =
      Eigen::Vector3d(Eigen::AngleAxisd(5 * kPi / 180, Eigen::Vector3d::UnitZ()) * *task.stiffness.force_n);
  turned.x = {1.6, 1.6, 1};
  turned.y = {0.4, 0.4, 1};
  CHECK(*moves[10].score == Approx(search_poses(robot, turned, 0, 1).best.score).epsilon(1e-6));
}
