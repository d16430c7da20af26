#include "document/text/table_text.h"

#include <catch2/catch.hpp>

#include "document/text/data_error.h"

using namespace stablecut;
using namespace stablecut::document;

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
  // Tabs: an empty first cell, against lines that are all indented.
  const auto empty_first = table_rows({"f", "a\tb\tc\td\n\t2\t3\t4\n\t\t5\t6\n"});
  REQUIRE(empty_first.size() == 3);
  CHECK(empty_first[1].fields == std::vector<std::string>{"", "2", "3", "4"});
  CHECK(empty_first[2].fields == std::vector<std::string>{"", "", "5", "6"});
  CHECK(table_rows({"f", "\t1\t2\n\t3\t4\n"})[1].fields == std::vector<std::string>{"3", "4"});
  CHECK(table_rows({"f", "\t1 2\n3 4\n"})[0].fields == std::vector<std::string>{"1", "2"});
  CHECK_THROWS_WITH(table_rows({"f", std::string("\xFF\xFE"
                                                 "1\0,",
                                                 5)}),
                    Catch::Contains("UTF-8"));
}
