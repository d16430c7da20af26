// Distributions that intervals and comparisons need.
#pragma once

#include <Eigen/Core>

namespace stablecut::numerics {

/// Probability that a standard normal variable lies below x.
double normal_cdf(double x);

/// Probability that a Student t variable with `dof` > 0 degrees of freedom lies below x.
double student_t_cdf(double x, double dof);

/// The x below which a Student t variable lies with probability p in (0, 1); relative error 1e-14. An
/// infinite `dof` is the normal distribution.
double student_t_quantile(double p, double dof);

/// Whether the mean of some values is above 0 by Student's one-sided test: chance does that with a
/// probability of `tail`. False for fewer than two values.
bool mean_above_zero(const Eigen::VectorXd& values, double tail);

/// Probability that a chi-square variable with `dof` > 0 degrees of freedom exceeds x.
double chi_square_tail(double x, double dof);

/// Probability that an F variable with `numerator` and `denominator` degrees of freedom exceeds x.
double f_tail(double x, double numerator, double denominator);

}  // namespace stablecut::numerics
