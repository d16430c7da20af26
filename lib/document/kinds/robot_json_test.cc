#include "document/kinds/robot_json.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <sstream>

#include "base/units.h"
#include "document/kinds/joints_json.h"
#include "document/kinds/load_samples_json.h"
#include "document/text/data_error.h"
#include "robot/inverse.h"

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

TEST_CASE("spreadsheet headers: names, units and order are the user's") {
  const Source robot_source = file("kr360.json");
  const robot::Robot robot = robot_from_json(parse_json(robot_source), robot_source);
  const Source csv{"t.csv",
                   "\xEF\xBB\xBF\"q6\"\tJ5\tA4 [rad]\taxis 3\ttheta2\tA1 (deg)\tForce X\tf_y_kn\tFz/N\tMx [N "
                   "m]\tMy\tMz\trx\try\trot_z_mrad\t"
                   "Delta x (\xc2\xb5m)\tuy\tdisplacement_z_m\tmeasuring point x [mm]\tmeasuring point y "
                   "[mm]\tmeasuring point z [mm]\tstd_um\tstd_rad\tcomment\r\n"
                   "6\t5\t0,5\t3\t2\t1\t10\t0,02\t-30\t4\t0\t0\t0\t0\t5\t100\t0,2\t0,0003\t150\t0\t0\t8\t1e-"
                   "5\tfirst\r\n\t\t\t\t\t\t\t\t\t\t\t\t\t\t\t\t\t\t\t\t\r\n"};
  const auto document = load_samples_from_csv(csv, robot, {true, true, true});
  REQUIRE(document.samples.size() == 1);
  const robot::LoadSample& sample = document.samples.front();
  const auto deg = [](double d) { return radians_from_degrees(d); };
  CHECK((sample.angles - (robot::JointAngles() << deg(1), deg(2), deg(3), 0.5, deg(5), deg(6)).finished())
            .norm() < 1e-15);
  CHECK((sample.force_n - Eigen::Vector3d(10, 20, -30)).norm() < 1e-12);
  CHECK(sample.moment_n_m == Eigen::Vector3d(4, 0, 0));
  CHECK((sample.deflection_m - Eigen::Vector3d(1e-4, 2e-4, 3e-4)).norm() < 1e-18);
  REQUIRE(sample.rotation_rad);
  CHECK(*sample.rotation_rad == Eigen::Vector3d(0, 0, 5e-3));
  CHECK((sample.measuring_point - Eigen::Vector3d(0.15, 0, 0)).norm() < 1e-15);
  CHECK(sample.force_point == robot.tool.translation());
  CHECK(sample.deflection_std_m->x() == Approx(8e-6));
  CHECK(sample.rotation_std_rad->x() == Approx(1e-5));
  CHECK(document.places.front() == "line 2");

  // A rotation or a point with a component missing is not one with a 0.
  const Source partial{"t.csv", "A1,A2,A3,A4,A5,A6,Fx,Fy,Fz,dx,dy,dz,rz\n1,2,3,4,5,6,7,8,9,1,2,3,4\n"};
  CHECK_THROWS_WITH(load_samples_from_csv(partial, robot, {true, true, true}), Catch::Contains("column rx"));
}
