#include "document/measured/given_poles.h"

#include <catch2/catch.hpp>

#include "base/units.h"
#include "document/text/data_error.h"

using namespace stablecut;
using namespace stablecut::document;

namespace {

std::string complaint(const std::string& text) {
  try {
    given_poles({{"p", text}, {}});
  } catch (const DataError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("poles of columns, in any order and beside others") {
  const auto poles =
      given_poles({{"p", "name,damping_ratio,frequency_hz\nfirst,0.6,10\nsecond,0.01,20\n"}, {}});
  REQUIRE(poles.size() == 2);
  CHECK(poles[0].pole.real() == Approx(-0.6 * rad_per_s_from_hz(10)));
  CHECK(poles[0].pole.imag() == Approx(0.8 * rad_per_s_from_hz(10)));
  CHECK(poles[1].directions.empty());
}

TEST_CASE("poles of a modal table, with the directions that they move") {
  const Json zero = {0, 0}, one = {1, 0};
  const Json document = {
      {"format", "stablecut/modal-table/1"},
      {"dofs", {"x", "y"}},
      {"modes",
       {{{"frequency_hz", 10}, {"damping_ratio", 0.1}, {"psi_r", {one, zero}}, {"psi_l", {one, zero}}},
        {{"frequency_hz", 20}, {"damping_ratio", 0.1}, {"psi_r", {one, one}}, {"psi_l", {one, one}}}}}};
  const auto poles = given_poles({{"p", ""}, document});
  REQUIRE(poles.size() == 2);
  CHECK(poles[0].directions == std::vector<std::string>{"x"});
  CHECK(poles[1].directions == std::vector<std::string>{"x", "y"});
  CHECK(std::abs(poles[1].pole) == Approx(rad_per_s_from_hz(20)));
}

TEST_CASE("what is no list of poles is named") {
  CHECK(complaint("").find("p: expected a modal-table, or a header frequency_hz,damping_ratio") == 0);
  CHECK(complaint("f,z\n1,2\n") == "p: line 1: expected a column frequency_hz");
  CHECK(complaint("frequency_hz,damping\n1,2\n") == "p: line 1: expected a column damping_ratio");
  CHECK(complaint("frequency_hz,damping_ratio\n1,1\n") ==
        "p: line 2: 1: expected a damping ratio above 0 and below 1");
  CHECK(
      complaint("frequency_hz,damping_ratio\n-1,0.1\n").find("p: line 2: -1: expected a frequency above 0") ==
      0);
  CHECK(complaint("frequency_hz,damping_ratio\n1,0.1\n1,0.1\n") ==
        "p: line 3: 1 Hz: expected each pole once");
  CHECK(complaint("frequency_hz,damping_ratio\n1,x\n").find("p: line 2: \"x\": expected a damping ratio") ==
        0);
}
