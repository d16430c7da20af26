#include "document/text/label.h"

#include <catch2/catch.hpp>

using namespace stablecut::document;

TEST_CASE("a document's label is its text, and nothing where it has none") {
  CHECK(label_of(Json{{"label", "pose 3"}}) == "pose 3");
  CHECK(label_of(Json{{"label", 3}}).empty());
  CHECK(label_of(Json{{"format", "stablecut/frf/1"}}).empty());
  CHECK(label_of(Json::array({"label"})).empty());
  CHECK(label_of(nullptr).empty());
}

TEST_CASE("labels of several inputs stand beside each other, each part once") {
  CHECK(joined_labels({}).empty());
  CHECK(joined_labels({"", ""}).empty());
  CHECK(joined_labels({"pose 3", "", "slot"}) == "pose 3, slot");
  // The robot's label came with the stiffness too.
  CHECK(joined_labels({"cell 2", "cell 2, loads of May", "May"}) == "cell 2, loads of May, May");
  CHECK(joined_labels({"a, ", ", b", "a"}) == "a, b");
}
