#include "document/text/node.h"

#include <catch2/catch.hpp>

#include "document/text/data_error.h"

using namespace stablecut;
using namespace stablecut::document;

namespace {

template <typename Read>
std::string complaint(const char* text, const Read& read) {
  const Source source{"f", text};
  const Json value = parse_json(source);
  try {
    read(Node(value, source));
  } catch (const DataError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("every check names file, pointer, value and what was expected") {
  CHECK(complaint(R"({"h": [{"re": [1, "x"]}]})", [](const Node& node) {
          node.at("h").items()[0].at("re").numbers();
        }) == "f: /h/0/re/1: \"x\": expected a finite number");
  CHECK(complaint(R"({"a": null})", [](const Node& node) { node.at("a").number(); }) ==
        "f: /a: null: expected a finite number");
  CHECK(complaint(R"({"a": 0})", [](const Node& node) { node.at("a").number(kPositive); }) ==
        "f: /a: 0: expected a number above 0");
  CHECK(complaint(R"({"a": 2.5})", [](const Node& node) { node.at("a").integer(1, 9); }) ==
        "f: /a: 2.5: expected a whole number from 1 to 9");
  CHECK(complaint(R"({"a": "up"})", [](const Node& node) {
          node.at("a").word({"left", "right"});
        }) == "f: /a: \"up\": expected \"left\" or \"right\"");
  CHECK(complaint(R"({})", [](const Node& node) { node.at("b/c"); }) ==
        "f: /b~1c: missing: expected this field");
  CHECK(complaint(R"([1])", [](const Node& node) { node.at("a"); }) ==
        "f: /: a list of 1: expected an object");
}

TEST_CASE("unknown names are errors that name the nearest known one, unless they begin with x_") {
  const auto check = [](const Node& node) {
    node.check_names({"depth_mm", "speed_rpm", "k2_n_m_per_rad", "teeth"});
  };
  const std::pair<const char*, const char*> wrong[] = {{"depht_mm", "depth_mm"},
                                                       {"depth_m", "depth_mm"},
                                                       {"depth", "depth_mm"},
                                                       {"dept_mm", "depth_mm"},
                                                       {"speed_hz", "speed_rpm"},
                                                       {"tooth", "teeth"},
                                                       {"sepeed_rpm", "speed_rpm"},
                                                       {"k2_n_mm_per_deg", "k2_n_m_per_rad"},
                                                       {"", "teeth"},
                                                       {"teeeeeeth", "teeth"}};
  for (const auto& [name, nearest] : wrong) {
    INFO(name);
    CHECK(complaint(("{\"" + std::string(name) + "\": 1}").c_str(), check) ==
          "f: /" + std::string(name) + ": unknown field: expected " + nearest +
              " (a field of your own starts with x_)");
  }
  CHECK(complaint(R"({"depth_mm": 1, "x_teet": 1, "x_remark": 2})", check).empty());
}

TEST_CASE("a document of another kind or version says which was found and which is read") {
  CHECK(complaint(R"({"format": "stablecut/cut/1"})", [](const Node& node) {
          document_root(node.json(), node.source(), "frf");
        }) == "f: /format: \"stablecut/cut/1\": expected \"stablecut/frf/1\"");
}
