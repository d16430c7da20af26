#include "numerics/exponential_moments.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "numerics/legendre.h"

namespace stablecut::numerics {
namespace {

using Complex = std::complex<double>;

constexpr double kSeriesReach = 0.5;  // |w| below which the quotient is summed
constexpr int kSeriesTerms = 20;
constexpr Eigen::Index kTail = 24;  // rows beyond the last wanted moment, besides |Re z|

// (exp(w) - 1) / w without cancellation.
Complex exponential_quotient(Complex w) {
  if (std::abs(w) > kSeriesReach) return (std::exp(w) - 1.0) / w;
  Complex term = 1, sum = 1;
  for (int k = 2; k < kSeriesTerms; ++k) {
    term *= w / static_cast<double>(k);
    sum += term;
  }
  return sum;
}

}  // namespace

Eigen::VectorXcd exponential_moments(Complex z, double x, Eigen::Index count) {
  const auto forward =
      std::abs(z.imag()) < 1 ? Eigen::Index{0} : static_cast<Eigen::Index>(std::abs(z.imag()));
  const Eigen::Index tail = std::max(count, forward) + kTail + static_cast<Eigen::Index>(std::abs(z.real()));
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
  std::vector<Complex> pivot(tail);
  for (Eigen::Index j = forward + 1; j < tail; ++j) {
    Complex right = -jump(j);
    Complex diagonal = -odd(j);
    if (j == forward + 1) {
      right += z * moment[forward];
    } else {
      const Complex factor = z / pivot[j - 1];
      diagonal += factor * z;
      right += factor * moment[j - 1];
    }
    if (j == tail - 1) right -= z * moment[tail];
    pivot[j] = diagonal;
    moment[j] = right;
  }
  for (Eigen::Index j = tail - 1; j > forward; --j) {
    if (j < tail - 1) moment[j] -= z * moment[j + 1];
    moment[j] /= pivot[j];
  }
  return moment.head(count);
}

}  // namespace stablecut::numerics
