#include "numerics/distributions.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stablecut::numerics {
namespace {

constexpr double kPrecision = 1e-16;
constexpr int kMostTerms = 10000;

// Regularized incomplete beta function I_x(a, b), by its continued fraction where that converges fast.
double incomplete_beta(double x, double a, double b) {
  if (x <= 0) return 0;
  if (x >= 1) return 1;
  if (x > (a + 1) / (a + b + 2)) return 1 - incomplete_beta(1 - x, b, a);
  const double front =
      std::exp(std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) + a * std::log(x) + b * std::log1p(-x)) /
      a;
  // Lentz's evaluation of 1 / (1 + d1 / (1 + d2 / ...)).
  constexpr double kTiny = 1e-300;
  double c = 1, d = 0, fraction = 1;
  for (int i = 0; i < kMostTerms; ++i) {
    const double m = i / 2;
    const double term = i == 0       ? 1
                        : i % 2 == 0 ? m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m))
                                     : -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1));
    d = 1 + term * d;
    d = 1 / (std::abs(d) < kTiny ? kTiny : d);
    c = 1 + term / c;
    if (std::abs(c) < kTiny) c = kTiny;
    fraction *= c * d;
    if (std::abs(1 - c * d) < kPrecision * 4) break;
  }
  return front * (fraction - 1);
}

// Regularized upper incomplete gamma function Q(a, x).
double upper_gamma(double a, double x) {
  if (x <= 0) return 1;
  const double front = std::exp(a * std::log(x) - x - std::lgamma(a));
  if (x < a + 1) {
    double term = 1 / a, sum = term;
    for (int n = 1; n < kMostTerms && term > kPrecision * sum; ++n) sum += term *= x / (a + n);
    return 1 - front * sum;
  }
  double b = x + 1 - a, c = 1e300, d = 1 / b, fraction = d;
  for (int n = 1; n < kMostTerms; ++n) {
    const double term = -n * (n - a);
    b += 2;
    d = 1 / (term * d + b);
    c = b + term / c;
    fraction *= c * d;
    if (std::abs(c * d - 1) < kPrecision * 4) break;
  }
  return front * fraction;
}

}  // namespace

double normal_cdf(double x) { return 0.5 * std::erfc(-x / std::sqrt(2.0)); }

double student_t_cdf(double x, double dof) {
  if (std::isinf(dof)) return normal_cdf(x);
  const double tail = 0.5 * incomplete_beta(dof / (dof + x * x), 0.5 * dof, 0.5);
  return x > 0 ? 1 - tail : tail;
}

double student_t_quantile(double p, double dof) {
  if (p < 0.5) return -student_t_quantile(1 - p, dof);
  double low = 0, high = 1;
  while (student_t_cdf(high, dof) < p && high < 1e300) high *= 2;
  for (int i = 0; i < 200 && high - low > 1e-13 * high; ++i) {
    const double middle = 0.5 * (low + high);
    (student_t_cdf(middle, dof) < p ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

double chi_square_tail(double x, double dof) { return upper_gamma(0.5 * dof, 0.5 * x); }

double f_tail(double x, double numerator, double denominator) {
  if (std::isinf(denominator)) return chi_square_tail(x * numerator, numerator);
  return incomplete_beta(denominator / (denominator + numerator * x), 0.5 * denominator, 0.5 * numerator);
}

}  // namespace stablecut::numerics
