// Integrals of an exponential against Legendre polynomials: the exact response of a mode to a polynomial
// force. README.md, "Exponential moments".
#pragma once

#include <Eigen/Core>
#include <complex>

namespace stablecut::numerics {

/// I_j(x) = integral over s from -1 to x of exp(z (x - s)) P_j(s), for j = 0 ... count-1, x in (-1, 1].
///
/// From (2j+1) P_j = P'_{j+1} - P'_{j-1} and integration by parts,
///   z I_{j+1} - (2j+1) I_j - z I_{j-1} = P_{j-1}(x) - P_{j+1}(x).
/// Forwards the recurrence is stable while j is below |Im z|; above, the wanted solution is the decaying one,
/// and the recurrence is solved as a tridiagonal system towards a tail where I_j has its first-order value
/// (Olver). Accurate to some 1e-13 of the largest I_j for Re z <= 0 and damping ratios -Re z / |z| up to one
/// half; a few digits less for |z| above 100.
class ExponentialMoments {
 public:
  /// The elimination, which is the same at every x.
  ExponentialMoments(std::complex<double> z, Eigen::Index count);

  /// How many Legendre polynomials at() wants.
  Eigen::Index legendre_count() const { return tail_ + 2; }
  /// [x.size() x count] At each x, from `legendre` [x.size() x at least legendre_count()]: the polynomials
  /// there.
  Eigen::MatrixXcd at(const Eigen::VectorXd& x, const Eigen::MatrixXd& legendre) const;
  Eigen::VectorXcd at(double x) const;

 private:
  std::complex<double> z_;
  Eigen::Index count_, forward_, tail_;
  Eigen::VectorXcd factor_, inverse_pivot_;  // [tail]
};

}  // namespace stablecut::numerics
