#include "base/range.h"

#include <catch2/catch.hpp>

using namespace stablecut;

TEST_CASE("a range holds both ends exactly") {
  const auto range = parse_range("5000:20000:4");
  REQUIRE(range);
  CHECK(range->values() == std::vector<double>{5000, 10000, 15000, 20000});
  CHECK(parse_range("0.1:0.7:3")->values().back() == 0.7);
  CHECK(parse_range("2:2:1")->values() == std::vector<double>{2});
  CHECK(parse_range("-180:175:72")->values().front() == -180);
}

TEST_CASE("what is not a range is nothing") {
  for (const char* text :
       {"", "1", "1:2", "1:2:0", "1:2:1", "2:1:5", "2:2:5", "a:2:5", "1:2:5:6", "1:inf:5", "nan:2:5",
        "1:2:10000001", "-1e308:1e308:3", "0:1e308:3", "1:2:2.5", "1:2:5 ", " 1:2:5", "1:2:-3", "1::3"}) {
    INFO(text);
    CHECK_FALSE(parse_range(text));
  }
}

TEST_CASE("numbers fill their text and are finite") {
  CHECK(parse_number("-1.5e3") == -1500.0);
  CHECK(parse_number("+2") == 2.0);
  for (const char* text : {"", "x", "1,5", "nan", "inf", "1e999", "0x10", "1 "}) {
    INFO(text);
    CHECK_FALSE(parse_number(text));
  }
}

TEST_CASE("index lists are sorted and unique") {
  CHECK(parse_index_list("14-15,1-3,2") == std::vector<int>{1, 2, 3, 14, 15});
  CHECK(parse_index_list("4-6,5-7,5,1,6-9") == std::vector<int>{1, 4, 5, 6, 7, 8, 9});
  // However often an index is named: a thousand sets of a million would take minutes.
  std::string often = "1-1000000";
  for (int i = 0; i < 1000; ++i) often += ",1-1000000";
  CHECK(parse_index_list(often)->size() == 1'000'000);
  for (const char* text : {"", "0", "3-1", "1,,2", "1-2-3", "-1", "a", "1-", "1-2000000000"}) {
    INFO(text);
    CHECK_FALSE(parse_index_list(text));
  }
}

TEST_CASE("a band has two increasing ends") {
  CHECK(parse_band("400:4500")->to == 4500);
  CHECK_FALSE(parse_band("4500:400"));
  CHECK_FALSE(parse_band("400"));
}

TEST_CASE("a vector has three numbers") {
  CHECK(parse_vector("400,0,-400") == std::array<double, 3>{400, 0, -400});
  for (const char* text : {"", "1,2", "1,2,3,4", "1,2,x", "1,,3", "1 2 3", "1,2,inf"})
    CHECK_FALSE(parse_vector(text));
}
