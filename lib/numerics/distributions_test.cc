#include "numerics/distributions.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "base/units.h"

using namespace stablecut;
using namespace stablecut::numerics;

TEST_CASE("quantiles of Student's t as in printed tables") {
  // Two-sided 95 %: 12.7062, 4.3027, 2.5706, 2.2281, 2.0423, and 1.9600 for the normal distribution.
  CHECK(student_t_quantile(0.975, 1) == Approx(12.7062047362).epsilon(1e-11));
  CHECK(student_t_quantile(0.975, 2) == Approx(4.30265272975).epsilon(1e-11));
  CHECK(student_t_quantile(0.975, 5) == Approx(2.57058183564).epsilon(1e-11));
  CHECK(student_t_quantile(0.975, 10) == Approx(2.22813885199).epsilon(1e-11));
  CHECK(student_t_quantile(0.975, 30) == Approx(2.04227245630).epsilon(1e-11));
  CHECK(student_t_quantile(0.975, std::numeric_limits<double>::infinity()) ==
        Approx(1.95996398454).epsilon(1e-11));
  CHECK(student_t_quantile(0.025, 5) == Approx(-2.57058183564).epsilon(1e-11));
}

TEST_CASE("closed forms of the distributions") {
  // t with 1 and 2 degrees of freedom; chi-square with 2 is exponential.
  for (const double x : {-3.0, -0.4, 0.0, 0.7, 12.0}) {
    CHECK(student_t_cdf(x, 1) == Approx(0.5 + std::atan(x) / kPi).margin(1e-13));
    CHECK(student_t_cdf(x, 2) == Approx(0.5 + x / (2 * std::sqrt(2 + x * x))).margin(1e-13));
  }
  for (const double x : {0.1, 1.0, 5.0, 40.0})
    CHECK(chi_square_tail(x, 2) == Approx(std::exp(-x / 2)).epsilon(1e-12));
  CHECK(chi_square_tail(18.3070380533, 10) == Approx(0.05).epsilon(1e-11));
  // F: 5 % above 4.256 with (2, 9); the square of Student's t with (1, n).
  CHECK(f_tail(4.2564947291, 2, 9) == Approx(0.05).epsilon(1e-8));
  CHECK(f_tail(4, 1, 7) == Approx(2 * (1 - student_t_cdf(2, 7))).epsilon(1e-10));
  CHECK(normal_cdf(1.95996398454) == Approx(0.975).epsilon(1e-10));
}

TEST_CASE("Student's test of a mean") {
  // Mean 3, deviation of the mean sqrt(2.5 / 5): t = 4.2426 with 4 degrees of freedom, tail 0.0066176.
  const Eigen::VectorXd values = Eigen::VectorXd::LinSpaced(5, 1, 5);
  const double tail = 1 - student_t_cdf(3 / std::sqrt(0.5), 4);
  CHECK(tail == Approx(0.0066176).epsilon(1e-4));
  CHECK(mean_above_zero(values, 1.001 * tail));
  CHECK_FALSE(mean_above_zero(values, 0.999 * tail));
  CHECK_FALSE(mean_above_zero(-values, 0.4));
  CHECK_FALSE(mean_above_zero(values.tail(1), 0.05));
}
