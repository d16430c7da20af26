#include "document/text/json_text.h"

#include <catch2/catch.hpp>
#include <limits>
#include <random>

#include "document/text/data_error.h"

using namespace stablecut;
using namespace stablecut::document;

namespace {

std::string complaint(const std::string& text) {
  try {
    parse_json({"in.json", text});
  } catch (const DataError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("broken JSON is named by line and pointer") {
  CHECK(complaint("") == "in.json: empty input: expected a JSON document");
  CHECK(complaint(" \n ") == "in.json: empty input: expected a JSON document");
  CHECK(complaint("{\"h\": [{\"re\": [1,\n 2, nan]}]}") ==
        "in.json: line 2: /h/0/re/2: nan: not JSON: expected a value or punctuation of JSON");
  CHECK(complaint("{\"a\": [1, 2").find("/a") != std::string::npos);
  CHECK(complaint("{\"a\": [1, 2").find("document ends here") != std::string::npos);
  CHECK(complaint("{\"a\": 1} x").find("line 1") != std::string::npos);
  CHECK(complaint("{\"a\": 1e999}") != "");
}

TEST_CASE("a duplicate key is named by its pointer") {
  CHECK(complaint(R"({"a": {"b": 1, "c": 2, "b": 3}})").find("in.json: /a/b: duplicate key") == 0);
  CHECK(complaint(R"([{"a": 1}, {"a": 1}])").empty());
}

TEST_CASE("text reads back to the same value") {
  std::mt19937_64 generator(1);
  Json numbers = Json::array();
  for (int i = 0; i < 1000; ++i) {
    const double value =
        std::ldexp(static_cast<double>(generator()), static_cast<int>(generator() % 400) - 200);
    numbers.push_back(value);
  }
  const Json value = {{"n", numbers},
                      {"empty", Json::array()},
                      {"pairs", {{1.5, 2.0}, {3.0, -4.0}}},
                      {"nested", {{{"a", 1}, {"b", nullptr}}, {{"a", 2}, {"b", "x\n\"y\""}}}},
                      {"z", Json::object()}};
  const std::string text = json_text(value);
  CHECK(parse_json({"", text}) == value);
  CHECK(json_text(parse_json({"", text})) == text);
}

TEST_CASE("a number that is not finite never reaches a document") {
  CHECK_THROWS_AS(json_text(Json(std::numeric_limits<double>::quiet_NaN())), std::logic_error);
  CHECK_THROWS_AS(json_text(Json{{"a", {1.0, std::numeric_limits<double>::infinity()}}}), std::logic_error);
}

TEST_CASE("documents are nested, but not without end") {
  const auto nested = [](std::size_t levels) {
    return std::string(levels, '[') + "1" + std::string(levels, ']');
  };
  CHECK(json_text(parse_json({"f", nested(150)})).size() > 300);
  CHECK_THROWS_WITH(parse_json({"f", nested(201)}), Catch::Contains("nested too deeply"));
}

TEST_CASE("UTF-8 with and without its mark, but no UTF-16") {
  CHECK(parse_json({"f", "\xEF\xBB\xBF[1]"}) == Json::array({1}));
  const std::string wide("\xFF\xFE[\0", 4);
  CHECK_THROWS_WITH(parse_json({"f", wide}), "f: UTF-16 text: expected UTF-8");
}
