// Small dense least-squares problems whose columns differ in size by orders of magnitude.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace stablecut::robot {

/// The upper triangular R [n x n] of A = Q R for a matrix [m x n], m >= n or not: |A x| = |R x| for every x.
/// Columns are scaled to length 1 meanwhile.
Eigen::MatrixXd triangular_factor(const Eigen::MatrixXd& a);

/// (A^T A)^-1 for a matrix [m x n] of full column rank: the covariance of the least-squares solution where
/// every row has deviation 1. By QR of the columns scaled to length 1.
Eigen::MatrixXd inverse_normal_matrix(const Eigen::MatrixXd& a);

/// The x [n] that minimizes |A x - b|, with x_i not below 0 where not_negative[i]. A has full column rank.
/// The active set method of [Lawson1995, chapter 23]: exact up to rounding.
Eigen::VectorXd bounded_least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b,
                                      const std::vector<bool>& not_negative);

}  // namespace stablecut::robot
