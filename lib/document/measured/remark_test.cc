#include "document/measured/remark.h"

#include <catch2/catch.hpp>

using namespace stablecut;
using namespace stablecut::document;

TEST_CASE("remarks in words, without the names of options") {
  const auto text = [](RemarkKind kind, const std::string& written = "", const std::string& entry = "",
                       const std::vector<double>& numbers = {}, const FilePlace& place = {}) {
    return remark_text({kind, "f", place, written, entry, numbers});
  };
  const FilePlace type{8, 1, 6}, unit{11, 1, 9};
  CHECK(text(RemarkKind::kNoFrequencyResponse, "function type 1, a time response", "", {1}, type) ==
        "f: line 8 (function 1, record 6): function type 1, a time response: left out: expected type 4, a "
        "frequency response");
  CHECK(text(RemarkKind::kResponseUnknown, "data type 0", "", {0}, unit) ==
        "f: line 11 (function 1, record 9): data type 0: left out: does not say what the response is");
  CHECK(text(RemarkKind::kUnitContradicted, "mm over N", "", {}, unit) ==
        "f: line 11 (function 1, record 9): mm over N: dataset 164 says otherwise, and is believed");
  CHECK(text(RemarkKind::kPhaseTakenAsDegrees, "", "xy", {180}) ==
        "f: the phase of xy has no unit: up to 180, taken as degrees");
  CHECK(text(RemarkKind::kPhaseTakenAsRadians, "", "xy", {3.14159265}, {1}) ==
        "f: line 1: the phase of xy has no unit: up to 3.14159, taken as radians");
  CHECK(text(RemarkKind::kSeveralNodes, "", "", {3, 1, 2147483647}) ==
        "f: responses at 3 and forces at 1 nodes: a direction is named with its node, as x@2147483647");
  CHECK(text(RemarkKind::kDirectionsOverruled, "xx", "yx") == "f: says xx: taken for yx");
  // What a file says is neither a name to be filled in nor more than one line.
  CHECK(text(RemarkKind::kFrequencyUnitUnknown, "{1}\n{entry}", "xy", {1}) ==
        "f: {1} {entry}: not known as a unit of frequency: taken as Hz");
  CHECK(remark_text({}) == ": left out: expected type 4, a frequency response");
  // Every kind has words, and none an option.
  for (int kind = 0; kind <= static_cast<int>(RemarkKind::kDirectionsOverruled); ++kind) {
    const std::string words = text(static_cast<RemarkKind>(kind), "W", "E", {1, 2, 3});
    INFO(words);
    CHECK(words.size() > 10);
    CHECK(words.find("--") == std::string::npos);
    CHECK(words.find_first_of("{}") == std::string::npos);
  }
}

TEST_CASE("a function that is left out is an error of the same words") {
  const DataError error =
      left_out_error({RemarkKind::kResponseUnknown, "f", {11, 1, 9}, "data type 0", "", {}});
  CHECK(std::string(error.what()) ==
        "f: line 11 (function 1, record 9): data type 0: does not say what the response is");
  CHECK(error.remedy() == Remedy::kQuantityOrUnit);
}

TEST_CASE("remarks that differ in their place only are the same") {
  const Remark one{RemarkKind::kUnitUnknown, "f", {11, 1, 9}, "V over N", "", {}};
  Remark other = one;
  other.place = {31, 2, 9};
  CHECK(same_but_for_place(one, other));
  other.written = "A over N";
  CHECK_FALSE(same_but_for_place(one, other));
}
