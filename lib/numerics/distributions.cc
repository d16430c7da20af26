#include "numerics/distributions.h"

#include <boost/math/distributions/students_t.hpp>
#include <boost/math/special_functions/beta.hpp>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>

namespace stablecut::numerics {
namespace {

// In double, not in the 80 bits that some processors have: the same digits everywhere.
using InDouble = boost::math::policies::policy<boost::math::policies::promote_double<false>>;
using StudentT = boost::math::students_t_distribution<double, InDouble>;

}  // namespace

double normal_cdf(double x) { return 0.5 * std::erfc(-x / std::sqrt(2.0)); }

double student_t_cdf(double x, double dof) { return boost::math::cdf(StudentT(dof), x); }

double student_t_quantile(double p, double dof) { return boost::math::quantile(StudentT(dof), p); }

bool mean_above_zero(const Eigen::VectorXd& values, double tail) {
  const auto count = static_cast<double>(values.size());
  if (!(count > 1)) return false;
  const double mean = values.mean();
  const double spread = std::sqrt((values.array() - mean).square().sum() / (count - 1) / count);
  return mean > student_t_quantile(1 - tail, count - 1) * spread;
}

double chi_square_tail(double x, double dof) { return boost::math::gamma_q(0.5 * dof, 0.5 * x, InDouble()); }

double f_tail(double x, double numerator, double denominator) {
  if (std::isinf(denominator)) return chi_square_tail(x * numerator, numerator);
  return boost::math::ibeta(0.5 * denominator, 0.5 * numerator, denominator / (denominator + numerator * x),
                            InDouble());
}

}  // namespace stablecut::numerics
