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

TEST_CASE("a weighted quantile with equal weights is the plain one, and a weight of two counts as two") {
  const std::vector<double> values = {4, 1, 3, 2};
  for (const double share : {0.0, 0.125, 0.3, 0.5, 0.9, 1.0})
    CHECK(weighted_quantile(values, {2, 2, 2, 2}, share) == Approx(*quantile({1, 2, 3, 4}, share)));
  CHECK(weighted_quantile({3, 1, 2}, {0, 1, 1}, 1.0) == 2);
  // 1 and, three times, 2: the middle of the latter's share is at 5/8.
  CHECK(weighted_quantile({2, 1}, {3, 1}, 0.625) == 2);
  CHECK(weighted_quantile({2, 1}, {3, 1}, 0.375) == 1.5);
}
