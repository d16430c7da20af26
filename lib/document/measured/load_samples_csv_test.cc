#include "document/measured/load_samples_csv.h"

#include <catch2/catch.hpp>
#include <fstream>
#include <sstream>

#include "base/units.h"
#include "document/kinds/robot_json.h"
#include "document/text/data_error.h"

using namespace stablecut;
using namespace stablecut::document;

namespace {

const robot::Robot& kr360() {
  static const robot::Robot kRobot = [] {
    std::ostringstream text;
    text << std::ifstream(std::string(STABLECUT_TESTDATA) + "/kr360.json").rdbuf();
    const Source source{"kr360.json", text.str()};
    return robot_from_json(parse_json(source), source);
  }();
  return kRobot;
}

LoadSamplesDocument read(const std::string& text,
                         const std::array<bool, 3>& components = {true, true, true}) {
  return load_samples_from_csv({"f", text}, kr360(), components);
}

const std::string kJointNames = "A1,A2,A3,A4,A5,A6,";
const std::string kAngles = "1,2,3,4,5,6,";

}  // namespace

TEST_CASE("columns of loads by their names, in any order and unit") {
  for (const char* text : {
           "1,2,3,4,5,6,0,0,600,0.1,0.2,0.3\n",
           "A1,A2,A3,A4,A5,A6,Fx,Fy,Fz,dx,dy,dz\n1,2,3,4,5,6,0,0,600,0.1,0.2,0.3\n",
           "dz_um,dy [mm],dx (m),fz_kn,fy,fx,q6,q5,q4,q3,q2,q1\n300,0.2,0.0001,0.6,0,0,6,5,4,3,2,1\n",
           "no,A1,joint 2,axis_3,theta4_deg,J5 (\xC2\xB0),a6_rad,force_x "
           "[N],force_y,force_z,ux/\xC2\xB5m,deflection "
           "y,delta_z,remark\n7,1,2,3,4,5,0.10471975511965977,0,0,600,100,0.2,0.3,windy\n",
           "A1;A2;A3;A4;A5;A6;Fx;Fy;Fz;dx;dy;dz\n1;2;3;4;5;6;0;0;600;0,1;0,2;0,3\n;;;;;;;;;;;\n",
       }) {
    INFO(text);
    const LoadSamplesDocument document = read(text);
    REQUIRE(document.samples.size() == 1);
    const robot::LoadSample& sample = document.samples[0];
    for (int j = 0; j < robot::kJoints; ++j)
      CHECK(sample.angles[j] == Approx(radians_from_degrees(j + 1)).epsilon(1e-14));
    CHECK((sample.force_n - Eigen::Vector3d(0, 0, 600)).norm() < 1e-12);
    CHECK((sample.deflection_m - Eigen::Vector3d(1e-4, 2e-4, 3e-4)).norm() < 1e-18);
    CHECK(sample.moment_n_m.norm() == 0);
    CHECK_FALSE(sample.rotation_rad);
    CHECK_FALSE(sample.deflection_std_m);
    CHECK(sample.force_point == kr360().tool.translation());
    CHECK(sample.measuring_point == kr360().tool.translation());
  }
}

TEST_CASE("spreadsheet headers: names, units and order are the user's") {
  const robot::Robot& robot = kr360();
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

TEST_CASE("moments, rotations, deviations and points") {
  const auto document = read(
      kJointNames + "Fx,Fy,Fz,dx,dy,dz,Mx [N.m],My_nmm,Mz [kNm],rx_mrad,ry,rz_deg,std_um,std_rad," +
      "force_point_x,force_point_y,force_point_z,measuring_point_x_m,measuring_point_y,measuring_point_z\n" +
      kAngles + "1,2,3,0,0,0,4,5000,0.006,1,0.002,3,5,1e-5,10,20,30,0.04,50,60\n");
  const robot::LoadSample& sample = document.samples.at(0);
  CHECK((sample.moment_n_m - Eigen::Vector3d(4, 5, 6)).norm() < 1e-12);
  REQUIRE(sample.rotation_rad);
  CHECK((*sample.rotation_rad - Eigen::Vector3d(1e-3, 2e-3, radians_from_degrees(3))).norm() < 1e-15);
  CHECK((*sample.deflection_std_m - Eigen::Vector3d::Constant(5e-6)).norm() < 1e-18);
  CHECK((*sample.rotation_std_rad - Eigen::Vector3d::Constant(1e-5)).norm() < 1e-18);
  CHECK((sample.force_point - Eigen::Vector3d(0.01, 0.02, 0.03)).norm() < 1e-15);
  CHECK((sample.measuring_point - Eigen::Vector3d(0.04, 0.05, 0.06)).norm() < 1e-15);
  CHECK(document.places.at(0) == "line 2");
}

TEST_CASE("components that are not used may be missing or hold anything") {
  CHECK(read(kJointNames + "Fx,Fy,Fz,dz\n" + kAngles + "1,2,3,0.5\n", {false, false, true})
            .samples.at(0)
            .deflection_m == Eigen::Vector3d(0, 0, 0.5e-3));
  CHECK(read(kJointNames + "Fx,Fy,Fz,dx,dz\n" + kAngles + "1,2,3,lost,0.5\n", {false, false, true})
            .samples.at(0)
            .deflection_m == Eigen::Vector3d(0, 0, 0.5e-3));
  CHECK_THROWS_AS(read(kJointNames + "Fx,Fy,Fz,dx,dz\n" + kAngles + "1,2,3,lost,0.5\n"), DataError);
}

TEST_CASE("what a table of loads lacks is named with its line") {
  const auto complaint = [](const std::string& text) -> std::string {
    try {
      read(text);
    } catch (const DataError& error) {
      return error.what();
    }
    return "";
  };
  const std::string header = kJointNames + "Fx,Fy,Fz,dx,dy,dz";
  CHECK(complaint("") == "f: empty input: expected joint angles, forces and deflections");
  CHECK(complaint("1,2,3\n").find("f: line 1: 3 columns: expected a header, or 12 columns") == 0);
  CHECK(complaint(header + ",dz_um\n1,2\n") == "f: line 1: \"dz_um\": expected each column once");
  CHECK(complaint(kJointNames + "Fx,Fy,Fz,dx,dy,dz [inch]\n1,2\n")
            .find("f: line 1: \"dz [inch]\": expected a unit") == 0);
  CHECK(complaint(header + ",rx\n1,2\n") == "f: line 1: expected a column ry in the header");
  CHECK(complaint(header + "\n" + kAngles + "0,0,1e10,0,0,0\n") ==
        "f: line 2: 1e10: expected a number of a robot's size");
  CHECK(complaint(header + ",std\n" + kAngles + "0,0,1,0,0,0,0\n") ==
        "f: line 2: 0: expected a standard deviation above 0");
  CHECK(complaint(header + ",rx,ry,rz,std\n" + kAngles + "0,0,1,0,0,0,0,0,0,1\n") ==
        "f: line 1: expected both std and std_rad where rotations are measured, or neither");
}
