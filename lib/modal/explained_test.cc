#include "modal/explained.h"

#include <catch2/catch.hpp>

#include "modal/modal_fixtures_test.h"

using namespace stablecut;
using namespace stablecut::modal;

TEST_CASE("modes that leave much of a band are no answer") {
  const dynamics::ModalModel truth = fixtures::close_pair();
  const FitData data = fixtures::data_of(truth, 1e-3);
  CHECK_FALSE(most_unexplained(data, truth.modes, 0.5));
  // Without the mode at 640 Hz: its resonance is missing, and its stiffness where the others have little.
  const std::vector<dynamics::Mode> fewer(truth.modes.begin(), truth.modes.end() - 1);
  const auto left = most_unexplained(data, fewer, 0.5);
  REQUIRE(left);
  CHECK(left->error > 0.5);
}
