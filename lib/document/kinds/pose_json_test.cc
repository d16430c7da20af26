#include "document/kinds/pose_json.h"

#include <catch2/catch.hpp>
#include <fstream>
#include <set>

using namespace stablecut;
using namespace stablecut::document;

TEST_CASE("the schemas of pose and pose-map name the indices that there are, and their units") {
  std::set<std::string> names, units;
  for (const robot::StiffnessIndex& index : robot::stiffness_indices()) {
    names.insert(index.name);
    units.insert(index.unit);
  }
  const Json::json_pointer enums("/properties/index/properties");
  for (const std::string kind : {"pose", "pose-map"}) {
    INFO("schemas/" << kind << ".schema.json");
    std::ifstream file(std::string(STABLECUT_TESTDATA) + "/../schemas/" + kind + ".schema.json");
    const Json properties = Json::parse(file).at(enums);
    CHECK(properties.at("name").at("enum").get<std::set<std::string>>() == names);
    CHECK(properties.at("unit").at("enum").get<std::set<std::string>>() == units);
  }
}
