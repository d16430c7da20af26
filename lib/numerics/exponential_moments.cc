#include "numerics/exponential_moments.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/units.h"

namespace stablecut::numerics {
namespace {

using Complex = std::complex<double>;

// (exp(w) - 1) / w without cancellation.
Complex exponential_quotient(Complex w) {
  if (std::abs(w) > 0.5) return (std::exp(w) - 1.0) / w;
  Complex term = 1, sum = 1;
  for (int k = 2; k < 20; ++k) {
    term *= w / static_cast<double>(k);
    sum += term;
  }
  return sum;
}

}  // namespace

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

Eigen::VectorXcd exponential_moments(Complex z, double x, Eigen::Index count) {
  const auto forward =
      std::abs(z.imag()) < 1 ? Eigen::Index{0} : static_cast<Eigen::Index>(std::abs(z.imag()));
  const Eigen::Index tail = std::max(count, forward) + 24 + static_cast<Eigen::Index>(std::abs(z.real()));
  const Eigen::VectorXd p = legendre_values(x, tail + 2);
  const auto jump = [&](Eigen::Index j) { return p[j + 1] - p[j - 1]; };
  const auto odd = [](Eigen::Index j) { return static_cast<double>(2 * j + 1); };

  Eigen::VectorXcd moment(tail + 1);
  moment[0] = (x + 1) * exponential_quotient(z * (x + 1));
  if (forward > 0) {
    moment[1] = (moment[0] - x - std::exp(z * (x + 1))) / z;
    for (Eigen::Index j = 1; j < forward; ++j) {
      moment[j + 1] = moment[j - 1] + (odd(j) * moment[j] - jump(j)) / z;
    }
  }

  // Unknown: j = forward+1 ... tail-1, row j: -z I_{j-1} - (2j+1) I_j + z I_{j+1} = -jump(j).
  moment[tail] = jump(tail) / odd(tail);
  std::vector<Complex> pivot(static_cast<std::size_t>(tail));
  for (Eigen::Index j = forward + 1; j < tail; ++j) {
    Complex right = -jump(j);
    Complex diagonal = -odd(j);
    if (j == forward + 1) {
      right += z * moment[forward];
    } else {
      const Complex factor = z / pivot[static_cast<std::size_t>(j - 1)];
      diagonal += factor * z;
      right += factor * moment[j - 1];
    }
    if (j == tail - 1) right -= z * moment[tail];
    pivot[static_cast<std::size_t>(j)] = diagonal;
    moment[j] = right;
  }
  for (Eigen::Index j = tail - 1; j > forward; --j) {
    if (j < tail - 1) moment[j] -= z * moment[j + 1];
    moment[j] /= pivot[static_cast<std::size_t>(j)];
  }
  return moment.head(count);
}

}  // namespace stablecut::numerics
