// Least squares by normal equations, from which groups of rows can be left out cheaply.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace stablecut::robot {

/// A x = b with x_i not below 0 where not_negative[i], in columns brought to length 1: half the digits of
/// bounded_least_squares(). What the equations leave open stays small. The methods work with the first
/// `count` columns.
class NormalEquations {
 public:
  /// A [rows x n], b [rows].
  NormalEquations(Eigen::MatrixXd a, Eigen::VectorXd b, std::vector<bool> not_negative);

  const Eigen::MatrixXd& a() const { return a_; }  ///< columns of length 1, or 0
  const Eigen::VectorXd& b() const { return b_; }
  const Eigen::VectorXd& lengths() const { return lengths_; }  ///< that the columns had; 1 for those of 0

  /// [count], of the columns as they were given.
  Eigen::VectorXd solution(Eigen::Index count) const;
  /// [rows] b - A x.
  Eigen::VectorXd residual(Eigen::Index count) const;
  /// [rows] The same, x of each group of rows from the rows of all others.
  Eigen::VectorXd left_out(Eigen::Index count, const std::vector<std::vector<Eigen::Index>>& groups) const;

 private:
  Eigen::VectorXd in_unit_columns(Eigen::MatrixXd matrix, const Eigen::VectorXd& right) const;

  Eigen::MatrixXd a_, matrix_;
  Eigen::VectorXd b_, right_, lengths_;
  std::vector<bool> not_negative_;
};

}  // namespace stablecut::robot
