#include "document/table_text.h"

#include <catch2/catch.hpp>

#include "document/error.h"
#include "document/frf_csv.h"

using namespace stablecut;

TEST_CASE("separators, comments, CRLF, byte-order mark, quotes, decimal commas") {
  for (const char* text : {"1.5,2,3\n", "\"1.5\",\"2\",\"3\"\n", "\xEF\xBB\xBF\"1.5\";2;3\r\n",
                           "# note\n\n1,5;2;3", "1.5\t2\t3", "  1.5   2 3 "}) {
    INFO(text);
    const auto rows = table_rows({"f", text});
    REQUIRE(rows.size() == 1);
    REQUIRE(rows[0].fields.size() == 3);
    CHECK(table_number({"f", text}, rows[0], 0, "a number") == 1.5);
  }
  const auto spreadsheet = table_rows({"f",
                                       "sep=,\r\n\"-1,5\",\"a, b\",\xE2\x88\x92"
                                       "2\r\n"});
  REQUIRE(spreadsheet.size() == 1);
  CHECK(spreadsheet[0].fields == std::vector<std::string>{"-1.5", "a, b", "-2"});
  CHECK(table_rows({"f", "1,2\r3,4\r"}).size() == 2);
  CHECK_THROWS_WITH(table_rows({"f", std::string("\xFF\xFE"
                                                 "1\0,",
                                                 5)}),
                    Catch::Contains("UTF-8"));
}

TEST_CASE("FRF columns by count and by name") {
  const auto plain = frf_from_csv({"f", "1\t2\t3\n2\t4\t5\n"}, Quantity::kMobility);
  REQUIRE(plain.entries.size() == 1);
  CHECK(plain.quantity == Quantity::kMobility);
  CHECK(plain.entries[0].h[1] == std::complex<double>(4, 5));
  const auto named =
      frf_from_csv({"f", "f_hz,Hxy (imag),Hxy (real),yy_re,yy_im\n1,2,3,4,5\n"}, Quantity::kReceptance);
  REQUIRE(named.entries.size() == 2);
  CHECK(named.find("x", "y")->h[0] == std::complex<double>(3, 2));
  CHECK(named.find("y", "y")->h[0] == std::complex<double>(4, 5));
}

TEST_CASE("a bad line is named") {
  const auto complaint = [](const char* text) -> std::string {
    try {
      frf_from_csv({"f", text}, Quantity::kReceptance);
    } catch (const DataError& error) {
      return error.what();
    }
    return "";
  };
  CHECK(complaint("") == "f: empty input: expected columns of numbers");
  CHECK(complaint("1,2,3\n2,x,3\n") == "f: line 2: \"x\": expected a real part in column 2");
  CHECK(complaint("1,2,3\n2,nan,3\n") == "f: line 2: \"nan\": expected a real part in column 2");
  CHECK(complaint("1,2,3\n1,2,3\n").find("f: line 2: 1: expected increasing") == 0);
  CHECK(complaint("1,2,3\n2,2\n") == "f: line 2: 2 columns: expected 3 as in the lines before");
  CHECK(complaint("1,2\n").find("f: line 1: 2 columns: expected 3 columns") == 0);
}
