// Polynomials through values at Chebyshev's nodes, as sums of his polynomials T_j. README.md, "Chebyshev".
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "base/units.h"

namespace stablecut::numerics {

/// Coefficients of T_0 ... T_{n-1}, or values at n nodes.
template <int n>
using ChebyshevSeries = Eigen::Matrix<double, n, 1>;

/// Node i of n in (-1, 1), increasing.
inline double chebyshev_node(Eigen::Index i, Eigen::Index n) {
  return -std::cos(kPi * (static_cast<double>(i) + 0.5) / static_cast<double>(n));
}

/// Coefficients from values at the nodes: coefficients = transform * values.
template <int n>
Eigen::Matrix<double, n, n> chebyshev_transform() {
  Eigen::Matrix<double, n, n> transform;
  for (Eigen::Index j = 0; j < n; ++j) {
    for (Eigen::Index i = 0; i < n; ++i) {
      const double angle = kPi * (static_cast<double>(n - 1 - i) + 0.5) / n;
      transform(j, i) = (j == 0 ? 1.0 : 2.0) / n * std::cos(static_cast<double>(j) * angle);
    }
  }
  return transform;
}

/// The series at x in [-1, 1], by the recurrence of [Clenshaw1955].
template <int n>
double chebyshev_value(const ChebyshevSeries<n>& coefficients, double x) {
  double next = 0, after = 0;
  for (Eigen::Index j = n - 1; j > 0; --j) {
    const double now = coefficients[j] + 2 * x * next - after;
    after = next;
    next = now;
  }
  return coefficients[0] + x * next - after;
}

}  // namespace stablecut::numerics
