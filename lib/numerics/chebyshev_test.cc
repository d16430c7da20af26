#include "numerics/chebyshev.h"

#include <catch2/catch.hpp>
#include <cmath>

using namespace stablecut::numerics;

TEST_CASE("a series through the nodes is the function, as far as its degree reaches") {
  constexpr int n = 8;
  const auto at_nodes = [&](auto function) {
    ChebyshevSeries<n> values;
    for (Eigen::Index i = 0; i < n; ++i) values[i] = function(chebyshev_node(i, n));
    return ChebyshevSeries<n>(chebyshev_transform<n>() * values);
  };
  const auto polynomial = [](double x) { return 3 - x + 2 * std::pow(x, 7); };
  const auto smooth = [](double x) { return std::exp(x); };
  for (const double x : {-1.0, -0.3, 0.0, 0.9, 1.0}) {
    CHECK(chebyshev_value<n>(at_nodes(polynomial), x) == Approx(polynomial(x)).margin(1e-14));
    // The interpolation error of exp on [-1, 1]: e / (2^7 8!).
    CHECK(std::abs(chebyshev_value<n>(at_nodes(smooth), x) - smooth(x)) < std::exp(1) / (128.0 * 40320));
  }
}
