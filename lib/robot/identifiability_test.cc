// What loads and measurements can see, at the thresholds.

#include "robot/identifiability.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "robot/load_fixtures_test.h"

using namespace stablecut;
using namespace stablecut::robot;
using namespace stablecut::robot::fixtures;

TEST_CASE("a load that is out of the vertical by a degree sees joint 1, by a hundredth of a degree not") {
  const Robot robot = kr360();
  const auto with_tilt = [&](double degrees) {
    const double tilt = radians_from_degrees(degrees);
    const Eigen::Vector3d load(0, 600 * std::sin(tilt), -600 * std::cos(tilt));
    return identify_stiffness(robot, samples_of(robot, {tool_down_poses(robot, {1.6}), {load}}), {});
  };
  CHECK(identified(with_tilt(0.01)) == "-23---");
  const Identification tilted = with_tilt(1);
  CHECK(tilted.identified(0));
  CHECK(worst_error(tilted) < 1e-9);
}

TEST_CASE("two poses that are the same to 1e-8 rad count as one, to 1e-3 rad as two") {
  const Robot robot = kr360();
  const JointAngles pose = (JointAngles() << 0.2, -1.7, 1.9, 0.3, 1.4, 0).finished();
  const auto rank_at = [&](double difference) {
    JointAngles other = pose;
    other[1] += difference;
    const auto samples = samples_of(robot, {{pose, other}, {kDown}});
    return identify_stiffness(robot, samples, {false, {false, false, true}}).rank;
  };
  CHECK(rank_at(0) == 1);
  CHECK(rank_at(1e-8) == 1);
  CHECK(rank_at(1e-3) == 2);
}

TEST_CASE("a joint apart from a mixture of two others keeps its own number") {
  // Columns 0 and 1 are parallel, column 2 stands apart, and nearly: the rest is unseen.
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(4, 6);
  a.col(0) << 1, 1, 0, 0;
  a.col(1) << 2, 2, 0, 0;
  a.col(2) << 1, 1, 1e-2, 0;
  const Identifiability seen = identifiability(a, Eigen::MatrixXd::Ones(4, 6), 6);
  CHECK(seen.rank == 2);
  CHECK(seen.independent.size() == 2);
  CHECK(seen.visibility[0] == Visibility::kInseparable);
  CHECK(seen.visibility[1] == Visibility::kInseparable);
  CHECK(seen.visibility[2] == Visibility::kVisible);
  for (int j = 3; j < 6; ++j) CHECK(seen.visibility[j] == Visibility::kUnseen);
  // Each of three columns in one mixture with the others.
  a.col(2) << 0, 0, 1, 0;
  a.col(1) = a.col(0) + 0.01 * a.col(2);
  const Identifiability mixed = identifiability(a, Eigen::MatrixXd::Ones(4, 6), 6);
  CHECK(mixed.rank == 2);
  for (int j = 0; j < 3; ++j) CHECK(mixed.visibility[j] == Visibility::kInseparable);
}
