#include "robot/given_poses.h"

#include <catch2/catch.hpp>

#include "robot/robot_fixtures_test.h"

using namespace stablecut;
using namespace stablecut::robot;
using namespace stablecut::robot::fixtures;

TEST_CASE("poses outside the limits are named with the joint that is farthest outside") {
  const Robot robot = kr360();
  const auto deg = [](double a1, double a2, double a3) {
    return JointAngles((JointAngles() << a1, a2, a3, 0, 0, 0).finished() * radians_from_degrees(1));
  };
  // A1 to 185, A2 to 20, A3 to 144; on a limit is inside.
  const auto outside =
      poses_outside_limits(robot, {deg(0, 20, 144), deg(186, 25, 0), deg(0, 0, 0), deg(0, 0, 150)});
  REQUIRE(outside.size() == 2);
  CHECK((outside[0].pose == 1 && outside[0].joint == 1));
  CHECK(outside[0].beyond_rad == Approx(radians_from_degrees(5)));
  CHECK((outside[1].pose == 3 && outside[1].joint == 2));
  // A coupled range: A3 = 144 and A2 = -20 turn joint 3 by 164.
  const auto coupled = poses_outside_limits(coupled_kr360(), {deg(0, -20, 144), deg(0, 10, 144)});
  REQUIRE(coupled.size() == 1);
  CHECK((coupled[0].pose == 0 && coupled[0].joint == 2));
  CHECK(coupled[0].beyond_rad == Approx(radians_from_degrees(20)));
}

TEST_CASE("angles that look like radians taken for degrees") {
  const auto written = [](double a, double b) {
    return JointAngles((JointAngles() << 0, a, b, 0, 0, 0).finished() * radians_from_degrees(1));
  };
  const auto largest = looks_like_radians({written(-1.57, 1.57), written(-1, 3.1)});
  REQUIRE(largest);
  CHECK(*largest == Approx(3.1));
  CHECK(looks_like_radians({written(6.283, 0)}));
  CHECK_FALSE(looks_like_radians({written(-1.57, 1.57), written(-90, 90)}));
  CHECK_FALSE(looks_like_radians({written(0, 0)}));      // the zero pose
  CHECK_FALSE(looks_like_radians({written(0.1, 0.2)}));  // near it
}
