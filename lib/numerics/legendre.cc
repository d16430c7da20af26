#include "numerics/legendre.h"

#include <algorithm>
#include <cmath>

#include "base/units.h"

namespace stablecut::numerics {

GaussRule gauss_legendre(Eigen::Index points) {
  GaussRule rule{Eigen::VectorXd(points), Eigen::VectorXd(points)};
  const auto n = static_cast<double>(points);
  for (Eigen::Index i = 0; i < points; ++i) {
    double x = -std::cos(kPi * (static_cast<double>(i) + 0.75) / (n + 0.5));
    double slope = 0;
    for (int iteration = 0; iteration < 100; ++iteration) {
      const Eigen::VectorXd p = legendre_values(x, points + 1);
      slope = n * (x * p[points] - (points > 0 ? p[points - 1] : 0.0)) / (x * x - 1);
      const double step = p[points] / slope;
      x -= step;
      if (std::abs(step) < 1e-15) break;
    }
    rule.node[i] = x;
    rule.weight[i] = 2 / ((1 - x * x) * slope * slope);
  }
  return rule;
}

Eigen::VectorXd legendre_values(double x, Eigen::Index count) {
  Eigen::VectorXd p(std::max<Eigen::Index>(count, 2));
  p[0] = 1;
  p[1] = x;
  for (Eigen::Index j = 1; j + 1 < count; ++j) {
    const auto k = static_cast<double>(j);
    p[j + 1] = ((2 * k + 1) * x * p[j] - k * p[j - 1]) / (k + 1);
  }
  p.conservativeResize(count);
  return p;
}

Eigen::VectorXd orthonormal_legendre(double x, Eigen::Index count) {
  Eigen::VectorXd values = legendre_values(x, count);
  for (Eigen::Index m = 0; m < count; ++m) values[m] *= std::sqrt(static_cast<double>(m) + 0.5);
  return values;
}

Eigen::MatrixXd legendre_transform(const GaussRule& rule) {
  const Eigen::Index n = rule.node.size();
  Eigen::MatrixXd transform(n, n);
  for (Eigen::Index i = 0; i < n; ++i) transform.col(i) = rule.weight[i] * legendre_values(rule.node[i], n);
  for (Eigen::Index j = 0; j < n; ++j) transform.row(j) *= static_cast<double>(2 * j + 1) / 2;
  return transform;
}

}  // namespace stablecut::numerics
