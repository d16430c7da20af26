#include "document/kinds/robot_json.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <sstream>

#include "base/units.h"
#include "document/kinds/joints_json.h"
#include "document/text/data_error.h"
#include "robot/inverse.h"
#include "robot/kinematics.h"

using namespace stablecut;
using namespace stablecut::document;

namespace {

Source file(const std::string& name) {
  std::ifstream stream(std::string(STABLECUT_TESTDATA) + "/" + name);
  std::ostringstream text;
  text << stream.rdbuf();
  return {name, text.str()};
}

}  // namespace

TEST_CASE("the real controller's pairs: forward to 0.03 mm and 1e-4 rad, and back among the branches") {
  const Source robot_source = file("kr360.json"), source = file("krc-pairs.json");
  robot::Robot robot = robot_from_json(parse_json(robot_source), robot_source);
  robot.tool = Eigen::Isometry3d::Identity();  // flange poses
  const robot::InverseKinematics inverse(robot);
  const Json document = parse_json(source);
  const auto pairs = Node(document, source).at("pairs").items(1);
  CHECK(pairs.size() == 10);
  for (const Node& pair : pairs) {
    const robot::JointAngles angles = joint_angles_from(pair.at("joints_deg"));
    const Eigen::Vector3d abc = vector_from(pair.at("abc_deg")) * radians_from_degrees(1);
    Eigen::Isometry3d recorded = Eigen::Isometry3d::Identity();
    recorded.linear() = (Eigen::AngleAxisd(abc[0], Eigen::Vector3d::UnitZ()) *
                         Eigen::AngleAxisd(abc[1], Eigen::Vector3d::UnitY()) *
                         Eigen::AngleAxisd(abc[2], Eigen::Vector3d::UnitX()))
                            .matrix();
    recorded.translation() = vector_from(pair.at("xyz_mm")) * 1e-3;
    const Eigen::Isometry3d flange = robot::robot_pose(robot, angles).flange;
    INFO("pair " << pair.pointer());
    CHECK((flange.translation() - recorded.translation()).norm() < 0.03e-3);
    CHECK(Eigen::AngleAxisd(flange.linear().transpose() * recorded.linear()).angle() < 1e-4);

    // The recorded pose is rounded: angles within what 0.03 mm and 1e-4 rad leave open.
    const bool in_line = std::abs(angles[4]) < 1e-9;  // only A4 + A6 is determined
    double nearest = 9;
    for (const auto& solution : inverse.solve(recorded)) {
      robot::JointAngles error = solution.angles - angles;
      if (in_line) {
        error[3] += error[5];
        error[4] = error[5] = 0;
      }
      for (double& value : error) value = std::remainder(value, kTwoPi);
      nearest = std::min(nearest, error.cwiseAbs().maxCoeff());
    }
    CHECK(nearest < 3e-4);
  }
}

TEST_CASE("a robot document's frames are rotations to rounding") {
  const Source source = file("kr360.json");
  Json document = parse_json(source);
  CHECK(robot_from_json(document, source).flange.linear() ==
        (Eigen::Matrix3d() << -1, 0, 0, 0, 1, 0, 0, 0, -1).finished());
  document["tool"]["rotation"] = {{0.8660254, 0, 0.5}, {0, 1, 0}, {-0.5, 0, 0.8660254}};
  const Eigen::Matrix3d rotation = robot_from_json(document, source).tool.linear();
  CHECK((rotation * rotation.transpose() - Eigen::Matrix3d::Identity()).norm() < 1e-15);
  document["tool"]["rotation"][0][0] = 0.9;
  CHECK_THROWS_AS(robot_from_json(document, source), DataError);
}

TEST_CASE("a robot document's coupling, base, masses and shapes") {
  const Source source = file("kr360.json");
  Json document = parse_json(source);
  const robot::Robot plain = robot_from_json(document, source);
  CHECK((plain.base.matrix() == Eigen::Matrix4d::Identity() && plain.keep_out_radius_m == 0));
  document["coupling"] = {{{"joint", "A3"}, {"follows", "A2"}, {"ratio", -1}}};
  document["base"] = {{"translation_mm", {1000, 0, 500}}, {"rotation", {{0, -1, 0}, {1, 0, 0}, {0, 0, 1}}}};
  document["keep_out_radius_mm"] = 600;
  const Json capsule = {{"from_mm", {0, 0, 0}}, {"to_mm", {1300, 0, 0}}, {"radius_mm", 250}};
  document["base_capsules"] = {capsule};
  Json& third = document["joints"][2];
  third["coupled_min_deg"] = -90;
  third["coupled_max_deg"] = 120;
  third["mass_kg"] = 300;
  third["center_mm"] = {10, 20, 30};
  third["capsules"] = {capsule, capsule};
  const robot::Robot robot = robot_from_json(document, source);
  const robot::Joint& joint = robot.joints[2];
  REQUIRE(joint.coupling);
  CHECK((joint.coupling->follows == 1 && joint.coupling->ratio == -1));
  CHECK_FALSE(robot.joints[1].coupling);
  CHECK(joint.coupled_min_rad == Approx(-kPi / 2));
  CHECK(joint.coupled_max_rad == Approx(kPi * 2 / 3));
  REQUIRE(joint.mass);
  CHECK((joint.mass->mass_kg == 300 && joint.mass->center_m.isApprox(Eigen::Vector3d(0.01, 0.02, 0.03))));
  REQUIRE(joint.capsules.size() == 2);
  CHECK((joint.capsules[1].to_m.isApprox(Eigen::Vector3d(1.3, 0, 0)) && joint.capsules[1].radius_m == 0.25));
  CHECK(robot.base_capsules.size() == 1);
  CHECK(robot.keep_out_radius_m == 0.6);
  // The robot stands at (1000, 0, 500), turned by 90 degrees about z, and angle 3 loses what angle 2 turns.
  const auto tool_at = [](const robot::Robot& of, double a2, double a3) -> Eigen::Vector3d {
    return robot::robot_pose(of, (robot::JointAngles() << 0.3, a2, a3, 0.4, 0.5, 0.6).finished())
        .tool.translation();
  };
  const Eigen::Vector3d p = tool_at(plain, -1, 0.5 + 1);
  CHECK((tool_at(robot, -1, 0.5) - Eigen::Vector3d(1 - p.y(), p.x(), 0.5 + p.z())).norm() < 1e-14);
}
