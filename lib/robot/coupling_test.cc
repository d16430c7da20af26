// Axes whose angles follow another axis, and robots that do not stand in the base frame's origin.
#include <catch2/catch.hpp>
#include <cmath>

#include "robot/compliance.h"
#include "robot/inverse.h"
#include "robot/kinematics.h"
#include "robot/pose_families.h"
#include "robot/pose_search.h"
#include "robot/robot_fixtures_test.h"

using namespace stablecut;
using namespace stablecut::robot;
using namespace stablecut::robot::fixtures;

namespace {

double difference(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return (a.matrix() - b.matrix()).cwiseAbs().maxCoeff();
}

double score_of(const Robot& robot, const PoseTask& task) {
  const PoseSearch search = search_poses(robot, task, 0, 1, {}, nullptr);
  CHECK(limit_margin_rad(robot, search.best.angles) >= task.limit_margin_rad - 1e-9);
  return search.best.score;
}

}  // namespace

TEST_CASE("a forearm that is measured against the horizontal keeps its direction when axis 2 moves") {
  const Robot robot = coupled_kr360(), plain = kr360();
  std::mt19937_64 generator(5);
  for (int n = 0; n < 50; ++n) {
    JointAngles angles = random_angles(robot, generator);
    const RobotPose pose = robot_pose(robot, angles);
    CHECK(difference(pose.tool, robot_pose(plain, joint_turns(robot, angles)).tool) < 1e-14);
    CHECK((angles_of_turns(robot, joint_turns(robot, angles)) - angles).cwiseAbs().maxCoeff() < 1e-14);
    // Axes 2 and 3 of the KR360 are parallel and turn the same way.
    angles[1] += 0.3;
    CHECK((robot_pose(robot, angles).tool.linear() - pose.tool.linear()).cwiseAbs().maxCoeff() < 1e-14);
  }
}

TEST_CASE("a coupled joint yields as its own turn does") {
  const Robot robot = coupled_kr360(), plain = kr360();
  std::mt19937_64 generator(6);
  for (int n = 0; n < 20; ++n) {
    const JointAngles angles = random_angles(robot, generator);
    const RobotPose pose = robot_pose(robot, angles);
    const RobotPose same = robot_pose(plain, joint_turns(robot, angles));
    CHECK((jacobian(pose, pose.tool.translation()) - jacobian(same, same.tool.translation()))
              .cwiseAbs()
              .maxCoeff() < 1e-13);
  }
}

TEST_CASE("the copy that is chosen has the largest margin of all copies, coupled ranges included") {
  Robot robot = coupled_kr360();
  robot.joints[1].min_rad = -5;  // more than a turn: A2 has copies that A3 follows
  robot.joints[1].max_rad = 4;
  std::mt19937_64 generator(7);
  for (int n = 0; n < 200; ++n) {
    JointAngles angles = random_angles(robot, generator);
    for (int j = 0; j < kJoints; ++j) angles[j] += kTwoPi * std::floor(uniform(generator, -2, 3));
    const JointAngles chosen = most_central_copies(robot, angles);
    CHECK(difference(robot_pose(robot, chosen).tool, robot_pose(robot, angles).tool) < 1e-13);
    double most = -1e9;
    for (int a = -3; a <= 3; ++a) {
      for (int b = -4; b <= 4; ++b) {
        JointAngles copy = chosen;
        copy[1] += a * kTwoPi;
        copy[2] += b * kTwoPi;
        most = std::max(most, limit_margin_rad(robot, copy));
      }
    }
    CHECK(limit_margin_rad(robot, chosen) >= most - 1e-12);
  }
}

TEST_CASE("limits of a coupled range bound the turn, and those of the angle the angle") {
  const Robot robot = coupled_kr360();
  const Joint& third = robot.joints[2];
  JointAngles angles = JointAngles::Zero();
  angles[1] = -1;
  const AngleRange range = robot.range(2, angles);
  // turn = A3 - A2 = A3 + 1
  CHECK(range.min_rad == Approx(third.coupled_min_rad - 1));
  CHECK(range.max_rad == Approx(third.coupled_max_rad - 1));
  Robot narrow = robot;
  narrow.joints[2].max_rad = 0.5;
  CHECK(narrow.range(2, angles).max_rad == 0.5);
  narrow.joints[2].min_rad = 0.4;
  narrow.joints[2].coupled_max_rad = 0;
  CHECK(limit_margin_rad(narrow, angles) < 0);  // nothing is left
  const InverseKinematics inverse(robot);
  std::mt19937_64 generator(8);
  int inside = 0;
  for (int n = 0; n < 300; ++n) {
    const Eigen::Isometry3d tool = robot_pose(robot, random_angles(robot, generator)).tool;
    for (const InverseSolution& solution : inverse.solve(tool)) {
      if (solution.limit_margin_rad < 0) continue;
      ++inside;
      const double turn = robot.turn_rad(2, solution.angles);
      CHECK((turn >= third.coupled_min_rad && turn <= third.coupled_max_rad));
    }
  }
  CHECK(inside > 300);
}

TEST_CASE("a coupled robot with the same poses has the same optima") {
  const Robot plain = kr360(), coupled = coupled_kr360();
  for (const auto& [index, tool_x] : {std::pair("combined", 0.15), std::pair("deflection", 0.0)}) {
    PoseTask task = tool_down(plain, 1.2, index, 3);
    task.x = {0.5, 2.5, 21};  // a part of the plane, for speed
    task.y = {-1, 1, 21};
    task.stiffness.force_n = Eigen::Vector3d(300, 100, -400);
    const double expected = score_of(with_tool_offset(plain, tool_x), task);
    INFO(index << ", tool off axis 6 by " << tool_x);
    // 1e-6: what the search promises.
    CHECK(std::abs(score_of(with_tool_offset(coupled, tool_x), task) / expected - 1) < 1e-6);
  }
}

TEST_CASE("limits that only the coupled axis has bound the optimum") {
  // Straight down at 1.6 m the least deflection is at A2 = -130 with A3 = 66.6 or so; a controller that does
  // not let the forearm sink below the horizontal by so much leaves less.
  const Robot coupled = coupled_kr360();
  const PoseTask task = tool_down(kr360(), 1.6, "deflection", 2);
  const PoseSearch free_search = search_poses(coupled, task, 0, 1, {}, nullptr);
  Robot bounded = coupled;
  bounded.joints[2].max_rad = free_search.best.angles[2] - 0.1;
  const PoseSearch search = search_poses(bounded, task, 0, 1, {}, nullptr);
  CHECK(search.best.score > free_search.best.score * 1.001);
  CHECK(limit_margin_rad(bounded, search.best.angles) >= task.limit_margin_rad - 1e-9);
}

TEST_CASE("a robot that stands elsewhere answers a question that is moved with it alike", "[campaign]") {
  std::mt19937_64 generator(9);
  const Robot robot = with_tool_offset(kr360(), 0.1);
  PoseTask task = tool_down(robot, 1.2, "deflection", 2);
  task.stiffness.force_n = Eigen::Vector3d(300, 100, -400);
  const double expected = score_of(robot, task);
  for (int n = 0; n < 2; ++n) {
    Robot moved = robot;
    moved.base = random_frame(generator, 2);
    const Eigen::Matrix3d turn = moved.base.linear();
    PoseTask other = task;
    other.plane.origin = moved.base * task.plane.origin;
    other.plane.x_axis = turn * task.plane.x_axis;
    other.plane.y_axis = turn * task.plane.y_axis;
    other.tool_axis = turn * task.tool_axis;
    other.stiffness.force_n = turn * *task.stiffness.force_n;
    CHECK(std::abs(score_of(moved, other) / expected - 1) < 1e-6);
    const JointAngles angles = random_angles(robot, generator);
    CHECK(difference(robot_pose(moved, angles).tool, moved.base * robot_pose(robot, angles).tool) < 1e-14);
  }
}

TEST_CASE("a base turn is free about axis 1 of a base that is not upright, and about no other") {
  Robot robot = kr360();
  robot.base.linear() = Eigen::AngleAxisd(kPi / 2, Eigen::Vector3d::UnitX()).matrix();  // axis 1 along -y
  PoseTask task = tool_down(robot, 0, "weakest", 2);
  task.stiffness.force_n.reset();
  const auto turns_freely = [&](const Eigen::Vector3d& along) {
    task.tool_axis = -along;
    task.plane = {1.2 * along, along.unitOrthogonal(), along.cross(along.unitOrthogonal())};
    const auto reach = plane_reach(robot, task.plane, task.tool_axis);
    task.x = {reach.x.from, reach.x.to, 20};
    task.y = {reach.y.from, reach.y.to, 20};
    return symmetry_of(PoseScanner(robot, task)).base_turn;
  };
  CHECK(turns_freely(-Eigen::Vector3d::UnitY()));
  CHECK_FALSE(turns_freely(Eigen::Vector3d::UnitZ()));
}
