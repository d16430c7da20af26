#include "robot/kinematics.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "robot/arm_lanes.h"
#include "robot/robot_fixtures_test.h"

using namespace stablecut;
using namespace stablecut::robot;
using namespace stablecut::robot::fixtures;

TEST_CASE("the Jacobian is the derivative of the pose") {
  const Robot robot = with_tool_offset(kr360(), 0.2);
  std::mt19937_64 generator(3);
  for (int n = 0; n < 50; ++n) {
    const JointAngles angles = random_angles(robot, generator);
    const RobotPose pose = robot_pose(robot, angles);
    const Matrix6d j = jacobian(pose, pose.tool.translation());
    constexpr double kStep = 1e-6;
    for (int i = 0; i < kJoints; ++i) {
      JointAngles plus = angles, minus = angles;
      plus[i] += kStep;
      minus[i] -= kStep;
      const Eigen::Isometry3d a = robot_pose(robot, plus).tool, b = robot_pose(robot, minus).tool;
      const Eigen::Vector3d velocity = (a.translation() - b.translation()) / (2 * kStep);
      const Eigen::Matrix3d spin = (a.linear() - b.linear()) / (2 * kStep) * pose.tool.linear().transpose();
      CHECK((j.col(i).head<3>() - velocity).norm() < 1e-9);
      CHECK((j.col(i).tail<3>() - Eigen::Vector3d(spin(2, 1), spin(0, 2), spin(1, 0))).norm() < 1e-9);
    }
  }
}

TEST_CASE("redundancy angle 0 puts the tool's x axis nearest the base's x axis") {
  std::mt19937_64 generator(4);
  for (int n = 0; n < 50; ++n) {
    const Eigen::Vector3d axis =
        Eigen::Vector3d(numerics::unit_normal(generator), numerics::unit_normal(generator),
                        numerics::unit_normal(generator))
            .normalized();
    const double angle = uniform(generator, -3, 3);
    const Eigen::Isometry3d frame = tool_frame({0.1, 0.2, 0.3}, axis, angle);
    CHECK((frame.linear() * frame.linear().transpose() - Eigen::Matrix3d::Identity()).norm() < 1e-14);
    CHECK(frame.linear().determinant() == Approx(1));
    CHECK((frame.linear().col(2) - axis).norm() < 1e-15);
    CHECK(std::abs(redundancy_angle(frame) - angle) < 1e-12);
    const double nearest = tool_frame({0, 0, 0}, axis, 0).linear()(0, 0);
    for (const double turn : {-0.1, 0.1, 1.0, 3.0}) {
      CHECK(tool_frame({0, 0, 0}, axis, turn).linear()(0, 0) < nearest);
    }
  }
  CHECK(redundancy_angle(tool_frame({0, 0, 0}, Eigen::Vector3d::UnitX(), 0.5)) == Approx(0.5));
}

TEST_CASE("workspace of the KR360 with a bare flange, A1 = A5 = A6 = 0, to 5 mm") {
  Robot robot = kr360();
  robot.tool = Eigen::Isometry3d::Identity();
  // The section's outline comes from joints 2 and 3; with A5 = 0, A4 does not move the flange.
  double x_least = 9, x_most = -9, z_least = 9, z_most = -9;
  constexpr int kSteps = 1500;
  for (int a = 0; a <= kSteps; ++a) {
    for (int b = 0; b <= kSteps; ++b) {
      JointAngles angles = JointAngles::Zero();
      angles[1] = robot.joints[1].min_rad + 2 * robot.joints[1].half_range_rad() * a / kSteps;
      angles[2] = robot.joints[2].min_rad + 2 * robot.joints[2].half_range_rad() * b / kSteps;
      const Eigen::Vector3d p = robot_pose(robot, angles).flange.translation();
      x_least = std::min(x_least, p.x());
      x_most = std::max(x_most, p.x());
      z_least = std::min(z_least, p.z());
      z_most = std::max(z_most, p.z());
    }
  }
  // Paper: -1651..3116, -713..3661; the limits of this table: -1652..3116, -716..3661.
  CHECK(x_least == Approx(-1.652).margin(0.005));
  CHECK(x_most == Approx(3.116).margin(0.005));
  CHECK(z_least == Approx(-0.716).margin(0.005));
  CHECK(z_most == Approx(3.661).margin(0.005));
}

TEST_CASE("at 1.6 m the tool reaches a radius of 3.27 m in any orientation") {
  const Robot robot = kr360();
  double farthest = 0;
  constexpr int kSteps = 300;
  JointAngles angles = JointAngles::Zero();
  for (int a = 0; a <= kSteps; ++a) {
    for (int b = 0; b <= kSteps; ++b) {
      angles[1] = robot.joints[1].min_rad + 2 * robot.joints[1].half_range_rad() * a / kSteps;
      angles[2] = robot.joints[2].min_rad + 2 * robot.joints[2].half_range_rad() * b / kSteps;
      // The tool in the arm's plane: joint 5 swings its 500 mm about the wrist centre, to the height or to
      // its limit.
      const RobotPose pose = robot_pose(robot, angles);
      const Eigen::Vector3d wrist = pose.point.col(4), forward = -pose.axis.col(3);
      const double rise = 1.6 - wrist.z();
      if (std::abs(rise) > 0.5) continue;
      const double run = std::sqrt(0.25 - rise * rise);
      const double swing = std::acos(std::clamp((forward.x() * run + forward.z() * rise) / 0.5, -1.0, 1.0));
      if (swing <= robot.joints[4].max_rad) farthest = std::max(farthest, wrist.x() + run);
    }
  }
  CHECK(farthest == Approx(3.27).margin(0.005));
}

TEST_CASE("the quick test of the singularity margin agrees with the singular values") {
  const Robot robot = kr360();
  std::mt19937_64 generator(9);
  for (int n = 0; n < 2000; ++n) {
    JointAngles angles = random_angles(robot, generator);
    if (n % 2 == 0) angles[4] *= 0.02;
    const RobotPose pose = robot_pose(robot, angles);
    const double exact = singularity_margin(pose);
    CHECK(is_away_from_singularities(pose, exact * (1 - 1e-3)));
    if (exact > 1e-4) CHECK_FALSE(is_away_from_singularities(pose, exact * (1 + 1e-3)));
    CHECK(is_away_from_singularities(pose, 0));
  }
}
