// Small dense least-squares problems whose columns differ in size by orders of magnitude.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace stablecut::robot {

/// (A^T A)^-1 for a matrix [m x n] of full column rank: the covariance of the least-squares solution where
/// every row has deviation 1. By QR of the columns scaled to length 1.
Eigen::MatrixXd inverse_normal_matrix(const Eigen::MatrixXd& a);

/// The x [n] that minimizes |A x - b|, with x_i not below 0 where not_negative[i]; at most six unknowns.
/// Exact: every choice of unknowns held at 0 is tried, and the best solution that keeps the signs is taken
/// [Lawson1995, chapter 23].
Eigen::VectorXd bounded_least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b,
                                      const std::vector<bool>& not_negative);

}  // namespace stablecut::robot
