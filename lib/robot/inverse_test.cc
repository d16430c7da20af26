#include "robot/inverse.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "base/error.h"
#include "robot/kinematics.h"
#include "robot/robot_fixtures_test.h"

using namespace stablecut;
using namespace stablecut::robot;
using namespace stablecut::robot::fixtures;

namespace {

double residual(const Robot& robot, const JointAngles& angles, const Eigen::Isometry3d& tool) {
  return (robot_pose(robot, angles).tool.matrix() - tool.matrix()).cwiseAbs().maxCoeff();
}

// Largest difference to the nearest copy of any solution.
double distance_to_seed(const Robot& robot, const std::vector<InverseSolution>& solutions,
                        const JointAngles& seed) {
  double nearest = 1e9;
  for (const auto& solution : solutions) {
    for (const JointAngles& copy : copies_within_limits(robot, solution.angles, -1e-6)) {
      nearest = std::min(nearest, (copy - seed).cwiseAbs().maxCoeff());
    }
  }
  return nearest;
}

struct Tally {
  int poses = 0, solutions = 0, away = 0;
  double worst_residual = 0, worst_near = 0, worst_seed = 0;
};

Tally round_trips(const Robot& robot, int count, unsigned seed) {
  const InverseKinematics inverse(robot);
  std::mt19937_64 generator(seed);
  Tally tally;
  for (; tally.poses < count; ++tally.poses) {
    const JointAngles angles = random_angles(robot, generator);
    const RobotPose pose = robot_pose(robot, angles);
    const auto solutions = inverse.solve(pose.tool);
    const bool away = singularity_margin(pose) > 1e-3;
    tally.away += away;
    for (const auto& solution : solutions) {
      ++tally.solutions;
      const double error = residual(robot, solution.angles, pose.tool);
      (away ? tally.worst_residual : tally.worst_near) =
          std::max(away ? tally.worst_residual : tally.worst_near, error);
      REQUIRE(solution.limit_margin_rad == Approx(limit_margin_rad(robot, solution.angles)).margin(1e-12));
    }
    if (away) tally.worst_seed = std::max(tally.worst_seed, distance_to_seed(robot, solutions, angles));
  }
  return tally;
}

}  // namespace

TEST_CASE("20000 random poses of the KR360: each finds its seed, every branch returns to the pose") {
  const Tally tally = round_trips(kr360(), 20000, 1);
  CHECK(tally.poses == 20000);
  CHECK(tally.away > 19000);
  CHECK(tally.solutions > 4 * 20000);
  CHECK(tally.worst_residual < 1e-11);
  CHECK(tally.worst_near < 1e-9);
  CHECK(tally.worst_seed < 1e-8);
}

TEST_CASE("other robots with spherical wrists: offsets, senses, inclined axes, coupled axes, any base") {
  for (unsigned seed = 1; seed <= 30; ++seed) {
    const Tally tally = round_trips(random_robot(seed), 300, seed);
    INFO("robot " << seed);
    CHECK(tally.away > 250);
    CHECK(tally.worst_residual < 1e-11);
    CHECK(tally.worst_seed < 1e-7);
  }
}

TEST_CASE("what is singular has an answer, and the free joint its default") {
  const Robot robot = kr360();
  const InverseKinematics inverse(robot);
  const auto deg = [](double d) { return radians_from_degrees(d); };
  // Wrist in line; arm stretched; wrist centre on axis 1 (tool point above the base); all at once; folded.
  const double stretched_a3 = degrees_from_radians(std::atan2(-55, 1025));
  std::vector<JointAngles> poses;
  poses.push_back((JointAngles() << 0.3, deg(-90), deg(45), 0.7, 0, -0.2).finished());
  poses.push_back((JointAngles() << 0, deg(-60), deg(stretched_a3), 0.4, 0.5, 1).finished());
  poses.push_back((JointAngles() << 0, deg(-60), deg(stretched_a3), 0.4, 0, 1).finished());
  poses.push_back((JointAngles() << 0, deg(-90), deg(-90), 0, 0, 0).finished());
  // A2 with the wrist centre on axis 1, by bisection of its x.
  double low = deg(-130), high = deg(-90);
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    const RobotPose pose = robot_pose(robot, (JointAngles() << 0, middle, deg(20), 0, 0.4, 0).finished());
    (pose.point(0, 4) > 0 ? high : low) = middle;
  }
  poses.push_back((JointAngles() << 0, low, deg(20), 0, 0.4, 0).finished());
  for (const JointAngles& angles : poses) {
    const Eigen::Isometry3d tool = robot_pose(robot, angles).tool;
    const auto solutions = inverse.solve(tool);
    INFO("pose " << angles.transpose());
    REQUIRE_FALSE(solutions.empty());
    double least = 1;
    for (const auto& solution : solutions) {
      CHECK(solution.angles.allFinite());
      least = std::min(least, residual(robot, solution.angles, tool));
    }
    CHECK(least < 1e-7);
  }
  // Axes 4 and 6 in line: joint 4 takes 0, or what is asked for, and A4 + A6 stays (here both turn the same
  // way).
  const Eigen::Isometry3d in_line = robot_pose(robot, poses[0]).tool;
  const auto defaults = inverse.solve(in_line);
  const auto asked = inverse.solve(in_line, (JointAngles() << 0, 0, 0, 0.7, 0, 0).finished());
  const auto has = [](const std::vector<InverseSolution>& list, const JointAngles& angles) {
    return std::any_of(list.begin(), list.end(),
                       [&](const auto& s) { return (s.angles - angles).cwiseAbs().maxCoeff() < 1e-8; });
  };
  CHECK(has(asked, poses[0]));
  // With A5 = 0 axes 4 and 6 of this robot turn the flange the same way.
  JointAngles sum6 = poses[0];
  sum6[3] = 0;
  sum6[5] = poses[0][3] + poses[0][5];
  CHECK(has(defaults, sum6));
}

TEST_CASE("out of reach has no solution, and no NaN on the way") {
  const Robot robot = kr360();
  const InverseKinematics inverse(robot);
  Eigen::Isometry3d far = tool_frame({9, 0, 1}, -Eigen::Vector3d::UnitZ(), 0);
  CHECK(inverse.solve(far).empty());
  ArmLanes lanes;
  for (const double x : {0.0, 1e-12, 0.5, 2.825, 2.83, 9.0, 1e6}) {
    solve_arms(inverse.constants(), inverse.target_of(tool_frame({x, 0, 1.045}, {1, 0, 0}, 0)), lanes);
    for (const auto& joint : lanes.angle) {
      for (const double angle : joint) CHECK(std::isfinite(angle));
    }
    for (const double margin : lanes.limit_margin) CHECK_FALSE(std::isnan(margin));
  }
}

TEST_CASE("copies by whole turns stay inside the limits") {
  const Robot robot = kr360();
  const JointAngles angles = JointAngles::Zero();
  // A4 and A6 have -360, 0, 360 - of which only 0 is inside +-350 - and 10 has -350 and 10.
  CHECK(copies_within_limits(robot, angles, 0).size() == 1);
  JointAngles turned = angles;
  turned[3] = radians_from_degrees(10);
  turned[5] = radians_from_degrees(-100);
  CHECK(copies_within_limits(robot, turned, 0).size() == 4);
  CHECK(copies_within_limits(robot, turned, radians_from_degrees(1)).size() == 2);
}

TEST_CASE("robots without an analytic solution are refused with joint and field") {
  const auto with = [](auto change) {
    Robot robot = kr360();
    change(robot.joints);
    return unsupported_geometry(robot);
  };
  CHECK_FALSE(unsupported_geometry(kr360()));
  const auto breaks = [&](auto change, int joint, DhParameter parameter, GeometryRule rule) {
    const auto bad = with(change);
    REQUIRE(bad);
    CHECK(bad->joint == joint);
    CHECK(bad->parameter == parameter);
    CHECK(bad->rule == rule);
  };
  using Rule = GeometryRule;
  using Dh = DhParameter;
  breaks([](auto& j) { j[1].set_alpha(0); }, 1, Dh::kAlpha, Rule::kShoulderNotParallel);
  breaks([](auto& j) { j[2].set_alpha(0.1); }, 2, Dh::kAlpha, Rule::kElbowParallel);
  breaks([](auto& j) { j[2].a_m = 0; }, 2, Dh::kA, Rule::kUpperArm);
  breaks([](auto& j) { j[3].a_m = j[3].d_m = 0; }, 3, Dh::kD, Rule::kForearm);
  breaks([](auto& j) { j[4].a_m = 0.05; }, 4, Dh::kA, Rule::kWristCentre);
  breaks([](auto& j) { j[4].d_m = 0.1; }, 4, Dh::kD, Rule::kWristCentre);
  breaks([](auto& j) { j[5].a_m = 0.02; }, 5, Dh::kA, Rule::kWristCentre);
  breaks([](auto& j) { j[4].set_alpha(1); }, 4, Dh::kAlpha, Rule::kWristSquare);
  breaks([](auto& j) { j[5].set_alpha(1); }, 5, Dh::kAlpha, Rule::kWristSquare);
  Robot robot = kr360();
  robot.joints[5].a_m = 0.02;
  CHECK_THROWS_AS(InverseKinematics(robot), InvalidArgument);
}
