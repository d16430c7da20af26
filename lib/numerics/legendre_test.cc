#include "numerics/legendre.h"

#include <catch2/catch.hpp>

using namespace stablecut::numerics;

TEST_CASE("a Gauss rule integrates polynomials of degree 2n - 1 exactly") {
  for (const int points : {1, 2, 7, 24}) {
    const GaussRule rule = gauss_legendre(points);
    CHECK(rule.weight.sum() == Approx(2).epsilon(1e-14));
    const int degree = 2 * points - 2;  // even, so that the integral is not zero
    CHECK(rule.weight.dot(rule.node.array().pow(degree).matrix()) ==
          Approx(2.0 / (degree + 1)).epsilon(1e-12));
  }
}

TEST_CASE("coefficients from values at the nodes give the polynomial back") {
  const GaussRule rule = gauss_legendre(9);
  const Eigen::VectorXd coefficients = Eigen::VectorXd::LinSpaced(9, 1, -2);
  Eigen::VectorXd values(9);
  for (Eigen::Index i = 0; i < 9; ++i) values[i] = coefficients.dot(legendre_values(rule.node[i], 9));
  CHECK((legendre_transform(rule) * values - coefficients).norm() < 1e-14 * coefficients.norm());
}
