#include "numerics/order_statistics.h"

#include <catch2/catch.hpp>
#include <limits>

using namespace stablecut::numerics;

TEST_CASE("the median of an odd and of an even number of values") {
  CHECK(median({3, 1, 2}) == 2);
  CHECK(median({4, 1, 3, 2}) == 3);
  CHECK(median({7}) == 7);
}

TEST_CASE("quantiles stand between the values that their share lies between") {
  const std::vector<double> values = {1, 2, 3, 4};
  CHECK(*quantile(values, 0.5) == 2.5);
  CHECK(*quantile(values, 0.125) == 1);
  CHECK(*quantile(values, 0.0) == 1);
  CHECK(*quantile(values, 1.0) == 4);
  // What is infinite has no place.
  const double infinite = std::numeric_limits<double>::infinity();
  CHECK(*quantile({1, 2, infinite, infinite}, 0.375) == 2);
  CHECK_FALSE(quantile({1, 2, infinite, infinite}, 0.5));
  CHECK_FALSE(quantile({infinite, infinite}, 0.5));
}
