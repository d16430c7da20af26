#include "document/measured/tool_path_text.h"

#include <catch2/catch.hpp>

#include "document/text/data_error.h"

namespace stablecut::document {
namespace {

robot::ToolPath read(const std::string& text, ToolPathDefaults defaults = {std::nullopt, 0.02, false}) {
  return tool_path_from_text({"path.txt", text}, defaults).path;
}

void check_two(const robot::ToolPath& path, double speed) {
  REQUIRE(path.size() == 2);
  CHECK((path[0].position - Eigen::Vector3d(0.01, -0.0025, 0.003)).norm() < 1e-15);
  CHECK((path[0].axis + Eigen::Vector3d::UnitZ()).norm() < 1e-15);
  CHECK((path[1].position - Eigen::Vector3d(0.02, -0.0025, 0.003)).norm() < 1e-15);
  CHECK((path[1].axis + Eigen::Vector3d(0, 0.6, 0.8)).norm() < 1e-15);
  CHECK(path[1].speed == Approx(speed).epsilon(1e-12));
}

TEST_CASE("tool paths in whatever dress") {
  check_two(read("10 -2.5 3 0 0 1\n20 -2.5 3 0 0.6 0.8\n"), 0.02);
  check_two(read("x,y,z,i,j,k\n10,-2.5,3,0,0,1\n20,-2.5,3,0,0.6,0.8\n"), 0.02);
  check_two(read("x [m];y [m];z [m];i;j;k;speed "
                 "[mm/min]\n0,01;-0,0025;0,003;0;0;1;600\n0,02;-0,0025;0,003;0;3;4;600\n"),
            0.01);
  check_two(read("x_mm,y_mm,z_mm,axis_x,axis_y,axis_z,speed_mm_per_s\n10,-2.5,3,0,0,-1,7\n20,-2.5,3,0,-0.6,-"
                 "0.8,7\n"),
            0.007);
  check_two(read("% \nO1000 (a part; by hand)\nN10 G90 G21\nN20 G1 X10 Y-2.5 Z3 I0 J0 K1 F600\nN30 x+20. j.6 "
                 "k.8 ; on\nM30\n"),
            0.01);
  check_two(read("X 10 Y -2.5 Z 3 I 0 J 0 K 1\r\nX 20 Y -2.5 Z 3 I 0 J 0.6 K 0.8\r\n"), 0.02);
  check_two(read("FEDRAT/1\nGOTO/10,-2.5,3\nGOTO/ 20, -2.5, 3, 0, 0.6, 0.8\n"), 0.02);
  check_two(read("10 -2.5 3 0 0 -1\n20 -2.5 3 0 -0.6 -0.8\n", {std::nullopt, 0.02, true}), 0.02);
  const auto down = read("1 2 3\n4 5 6\n");
  CHECK(down[1].axis == -Eigen::Vector3d::UnitZ());
  const auto fed = read("x,y,z,feed_x,feed_y,feed_z\n1,2,3,0,2,0\n");
  REQUIRE(fed[0].feed);
  CHECK(*fed[0].feed == Eigen::Vector3d::UnitY());
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  frame.translation() << 1, 2, 3;
  CHECK((read("1 2 3\n", {frame, 1, false})[0].position - Eigen::Vector3d(1.001, 2.002, 3.003)).norm() <
        1e-15);
}

TEST_CASE("tool paths that would be a guess are refused") {
  const auto refused = [](const std::string& text, const char* message,
                          ToolPathDefaults defaults = {std::nullopt, 0.02, false}) {
    CAPTURE(text);
    CHECK_THROWS_WITH(read(text, defaults), Catch::Contains(message));
  };
  refused("", "empty input");
  refused("1 2\n", "line 1: 2 columns");
  refused("x,y\n1,2\n", "expected a column z");
  refused("x,y,z,i\n1,2,3,0\n", "expected a column j");
  refused("x,x,y,z\n1,1,2,3\n", "expected each column once");
  refused("x [in],y,z\n1,2,3\n", "expected a unit");
  refused("1 2 a\n", "expected a number");
  refused("1 2 3 0 0 0\n", "expected a direction");
  refused("1 2 3\n", "expected a speed", {});
  refused("G1 X1 Y2\n", "line 1: expected X, Y and Z in the first move");
  refused("G1 X1 Y2 Z3\nG2 X3 I1\n", "line 2: G2: expected straight moves");
  refused("G1 X1 Y2 Z3 B30\n", "B30: expected the tool axis as I, J and K");
  refused("G91 X1 Y2 Z3\n", "expected absolute");
  refused("G20 X1 Y2 Z3\n", "expected mm");
  refused("LN X1 Y2 Z3 NX0 NY0 NZ1\n", "NX: expected the tool axis as I");
  refused("GOTO/1,2\n", "expected GOTO");
  refused("G1 X1 Y2 Z3 F0\n", "expected a speed above 0");
}

}  // namespace
}  // namespace stablecut::document
