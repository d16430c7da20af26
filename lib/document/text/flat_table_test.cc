#include "document/text/flat_table.h"

#include <algorithm>
#include <catch2/catch.hpp>

using namespace stablecut::document;

namespace {

std::string csv_of(const Json& document, const std::string& name) {
  for (const FlatTable& table : flat_tables(document)) {
    if (table.name == name) return csv_text(table);
  }
  return "no table " + name;
}

std::vector<std::string> names_of(const Json& document) {
  std::vector<std::string> names;
  for (const FlatTable& table : flat_tables(document)) names.push_back(table.name);
  return names;
}

}  // namespace

TEST_CASE("rows of objects are a table, whatever some of them lack") {
  const Json document = Json::parse(R"({"format": "stablecut/x/1", "limit": [
    {"speed_rpm": 9000, "depth_mm": 0.1, "interval_95_mm": [0.05, null]},
    {"speed_rpm": 9500, "depth_mm": null, "kind": "hopf, or \"flip\""}], "cut": {"teeth": 2}, "provenance": {"tool": "x"}})");
  CHECK(csv_of(document, "limit") ==
        "speed_rpm,depth_mm,interval_95_mm_1,interval_95_mm_2,kind\n"
        "9000,0.1,0.05,,\n"
        "9500,,,,\"hopf, or \"\"flip\"\"\"\n");
  CHECK(csv_of(document, "document") == "field,value\nformat,stablecut/x/1\ncut/teeth,2\n");
}

TEST_CASE("lists as long as each other are columns, complex numbers two") {
  const Json document =
      Json::parse(R"({"joints": ["a1", "a2"], "identifiable": [true, false], "covariance": [[1, 2], [2, 5]],
    "outliers": [], "band_hz": [5, 900, 3], "modes": [{"frequency_hz": 40, "psi_r": [[1, 0], [0.5, -2]]}]})");
  CHECK(csv_of(document, "joints") ==
        "joints,identifiable,covariance_1,covariance_2\na1,true,1,2\na2,false,2,5\n");
  CHECK(csv_of(document, "modes") ==
        "frequency_hz,psi_r_1_re,psi_r_1_im,psi_r_2_re,psi_r_2_im\n40,1,0,0.5,-2\n");
  CHECK(csv_of(document, "document") == "field,value\nband_hz_1,5\nband_hz_2,900\nband_hz_3,3\n");
  CHECK(names_of(document) == std::vector<std::string>{"document", "modes", "joints"});
}

TEST_CASE("a grid is a row a point, with its axes") {
  const Json document =
      Json::parse(R"({"format": "stablecut/lobes/1", "speed_rpm": [9000, 9500, 9900], "depth_mm": [0, 1],
    "spectral_radius": [[0.1, 0.2, 0.3], [0.4, 0.5, null]], "surface": {"location_error_um": [[1, 2, 3], [4, 5, 6]]}})");
  CHECK(csv_of(document, "grid") ==
        "speed_rpm,depth_mm,spectral_radius,surface/location_error_um\n"
        "9000,0,0.1,1\n9000,1,0.4,4\n9500,0,0.2,2\n9500,1,0.5,5\n9900,0,0.3,3\n9900,1,,6\n");
}

TEST_CASE("what does not fit into a row is a table that says of which") {
  const Json document = Json::parse(
      R"({"orders": [{"order": 1, "poles": [{"f": 3}, {"f": 4}]}, {"order": 2, "poles": [{"f": 5}]}],
    "points": [{"speed_rpm": 1, "samples_um": {"feed": [1,2,3,4,5,6,7,8,9,10,11,12,13]}}]})");
  CHECK(csv_of(document, "orders") == "order\n1\n2\n");
  CHECK(csv_of(document, "orders/poles") == "orders,f\n1,3\n1,4\n2,5\n");
  const std::string samples = csv_of(document, "points/samples_um/feed");
  CHECK(samples.starts_with("points,samples_um/feed\n1,1\n1,2\n"));
  CHECK(std::count(samples.begin(), samples.end(), '\n') == 14);
}

TEST_CASE("what rows hold for each line stands beside the line's frequency") {
  Json lines = Json::array(), values = Json::array();
  for (int i = 0; i < 20; ++i) {
    lines.push_back(i);
    values.push_back(i / 4.0);
  }
  const Json document = {{"frequency_hz", lines},
                         {"h", {{{"response", "x"}, {"reference", "y"}, {"re", values}, {"im", values}}}}};
  CHECK(csv_of(document, "frequency_hz")
            .starts_with("frequency_hz,h_x_y_re,h_x_y_im\n0,0.0,0.0\n1,0.25,0.25\n"));
  CHECK(csv_of(document, "h") == "response,reference\nx,y\n");
}

TEST_CASE("aligned text rounds, and says how long what it leaves out is") {
  const Json document = Json::parse(
      R"({"limit": [{"speed_rpm": 9000.123456, "kind": "hopf"}, {"speed_rpm": 10500, "kind": null}],
    "points": [{"a": 1}, {"a": 2}, {"a": 3}]})");
  CHECK(aligned_text(flat_tables(document), {2, 2}) ==
        "limit\n  speed_rpm  kind\n    9000.12  hopf\n      10500     -\n\npoints: 3 rows, 1 columns\n");
}
