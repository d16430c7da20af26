#include "document/kinds/tool_path_json.h"

#include <catch2/catch.hpp>

#include "document/text/data_error.h"

namespace stablecut::document {
namespace {

robot::ToolPath read(const std::string& text, const ToolPathDefaults& defaults = {}) {
  const Source source{"path.json", text};
  return tool_path_from_json(parse_json(source), source, defaults).path;
}

TEST_CASE("a tool path in its workpiece's frame") {
  const auto path = read(R"({"format": "stablecut/tool-path/1", "speed_mm_per_s": 40,
    "frame": {"translation_mm": [1000, 0, 500], "rotation": [[0, -1, 0], [1, 0, 0], [0, 0, 1]]},
    "points": [{"position_mm": [10, 20, 30], "axis": [0, 0, -2], "feed": [3, 0, 0]},
               {"position_mm": [0, 0, 0], "axis": [1, 0, 0], "speed_mm_per_s": 5}]})");
  REQUIRE(path.size() == 2);
  CHECK((path[0].position - Eigen::Vector3d(0.98, 0.01, 0.53)).norm() < 1e-15);
  CHECK((path[0].axis + Eigen::Vector3d::UnitZ()).norm() < 1e-15);
  REQUIRE(path[0].feed);
  CHECK((*path[0].feed - Eigen::Vector3d::UnitY()).norm() < 1e-15);
  CHECK(path[0].speed == Approx(0.04));
  CHECK((path[1].axis - Eigen::Vector3d::UnitY()).norm() < 1e-15);
  CHECK(!path[1].feed);
  CHECK(path[1].speed == Approx(0.005));
}

TEST_CASE("what a tool path lacks") {
  const auto refused = [](const std::string& text, const char* message,
                          const ToolPathDefaults& defaults = {}) {
    CHECK_THROWS_WITH(read(text, defaults), Catch::Contains(message));
  };
  const std::string head = R"({"format": "stablecut/tool-path/1", )";
  refused(head + R"("points": []})", "/points");
  refused(head + R"("points": [{"position_mm": [0, 0, 0], "axis": [0, 0, 1]}]})", "/points/0");
  refused(head + R"("speed_mm_per_s": 0, "points": [{"position_mm": [0, 0, 0], "axis": [0, 0, 1]}]})",
          "/speed_mm_per_s: 0: expected a speed above 0");
  refused(head + R"("speed_mm_per_s": 1, "points": [{"position_mm": [0, 0, 0], "axis": [0, 0, 0]}]})",
          "/points/0/axis");
  refused(
      head +
          R"("frame": {"translation_mm": [0, 0, 0], "rotation": [[1, 0, 0], [0, 1, 0], [0, 0, 1]]}, "points": []})",
      "/frame", {Eigen::Isometry3d::Identity(), std::nullopt, false});
}

}  // namespace
}  // namespace stablecut::document
