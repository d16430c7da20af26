// Sums over the lines that a fit with poles needs, without forming its Jacobian: README.md, "Sums over the
// lines".
//
// With phi_a(w) = 1 / (i w - a) and real weights, partial fractions give
//   sum w conj(phi_a) phi_b = -(S(b) + conj S(a)) / (b + conj a),   S(a) = sum w / (i w - a),
// and its derivatives in b and conj a give the same sums with phi^2. All poles lie in the left half plane, so
// that b + conj a is never zero. Gram matrices of n poles cost n sums over the lines instead of n^2.
#pragma once

#include <Eigen/Core>
#include <complex>

namespace stablecut::modal {

/// Values of 1 / (s - a) and 1 / (s - conj a) on the lines, for poles a.
struct PoleValues {
  PoleValues(const Eigen::VectorXcd& s, const Eigen::VectorXcd& poles);

  Eigen::VectorXcd pole;      ///< [poles] rad/s, negative real parts
  Eigen::MatrixXcd phi;       ///< [lines x poles]
  Eigen::MatrixXcd phi_conj;  ///< [lines x poles], of the conjugate poles
};

/// Adds residue / (s - pole) + conj(residue) / (s - conj pole) on the lines s = i omega to h.
void add_pole_pair(const Eigen::VectorXcd& s, std::complex<double> pole, std::complex<double> residue,
                   Eigen::VectorXcd& h);

/// Sums over the lines of phi times w, w h, w conj(h) and w |h|^2 (columns), for all poles and then for their
/// conjugates: [2 poles x 4]. phi is 1 / (s - pole), w the weights [lines], h the curve [lines].
Eigen::Matrix<std::complex<double>, Eigen::Dynamic, 4> data_pole_sums(const Eigen::VectorXcd& s,
                                                                      const Eigen::VectorXcd& poles,
                                                                      const Eigen::VectorXd& weight,
                                                                      const Eigen::VectorXcd& h);

/// Weighted inner products sum w conj(g_a) g_b over the lines of functions g of the poles: phi of pole k has
/// number 2 k, its square number 2 k + 1. g' is the same function of the conjugate pole.
class PoleGrams {
 public:
  explicit PoleGrams(const Eigen::VectorXcd& poles);

  /// From the sums of w phi and of w phi^2 over the lines, for all poles and then for their conjugates, with
  /// real weights w.
  void evaluate(const Eigen::VectorXcd& sum, const Eigen::VectorXcd& sum_squared);
  /// The same with complex weights, whose conjugates are in the sums `mirror`.
  void evaluate(const Eigen::VectorXcd& sum, const Eigen::VectorXcd& sum_squared,
                const Eigen::VectorXcd& mirror, const Eigen::VectorXcd& mirror_squared);

  Eigen::MatrixXcd same;      ///< [2 poles x 2 poles] sum w conj(g_a) g_b
  Eigen::MatrixXcd mirrored;  ///< sum w conj(g'_a) g'_b
  Eigen::MatrixXcd across;    ///< sum w conj(g_a) g'_b
  Eigen::MatrixXcd back;      ///< sum w conj(g'_a) g_b: for real weights not filled, the adjoint of `across`

 private:
  void fill(const Eigen::VectorXcd& sum, const Eigen::VectorXcd& sum_squared, const Eigen::VectorXcd& mirror,
            const Eigen::VectorXcd& mirror_squared, Eigen::Index row, Eigen::Index column,
            Eigen::MatrixXcd& gram) const;

  Eigen::Index poles_;
  Eigen::MatrixXcd inverse_;  // 1 / (b + conj a), of poles and conjugate poles
};

}  // namespace stablecut::modal
