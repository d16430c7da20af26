// Least squares by Levenberg's and Marquardt's method, from sums alone: README.md, "Least squares from their
// sums".
#pragma once

#include <Eigen/Core>
#include <functional>

namespace stablecut::numerics {

/// With r a residual and J its Jacobian with respect to n variables: |r|^2, J^T r [n], J^T J [n x n].
struct NormalEquations {
  double sum_of_squares = 0;
  Eigen::VectorXd gradient;
  Eigen::MatrixXd matrix;
};

/// At the variables [n]; without gradient and matrix where they are not wanted.
using SumsOfSquares = std::function<NormalEquations(const Eigen::VectorXd& x, bool with_matrix)>;

/// When a search ends.
struct LeastSquaresEffort {
  int steps = 100;
  /// A step that changes |r|^2 by a smaller share ends it.
  double tolerance = 1e-8;
};

struct LeastSquares {
  Eigen::VectorXd x;   ///< [n]
  NormalEquations at;  ///< there
  /// A step was smaller than the tolerance or than the rounding of x, or the last steps brought next to
  /// nothing.
  bool converged = false;
};

/// From `start` to a local minimum of |r|^2 inside lower..upper [n], by Levenberg-Marquardt [Levenberg1944]
/// [Marquardt1963], steps cut at the bounds [Kanzow2004]. Never ends above the start, which has to lie inside
/// and to have a finite sum. Deterministic. A step costs n^3 / 3 multiplications and one evaluation, with the
/// matrix where it is taken.
LeastSquares levenberg_marquardt(const SumsOfSquares& sums, const Eigen::VectorXd& start,
                                 const Eigen::VectorXd& lower, const Eigen::VectorXd& upper,
                                 const LeastSquaresEffort& effort);

}  // namespace stablecut::numerics
