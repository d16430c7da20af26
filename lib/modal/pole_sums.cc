#include "modal/pole_sums.h"

namespace stablecut {

using Complex = std::complex<double>;

PoleValues::PoleValues(const Eigen::VectorXcd& s, const Eigen::VectorXcd& poles)
    : pole(poles), phi(s.size(), poles.size()), phi_conj(s.size(), poles.size()) {
  for (Eigen::Index k = 0; k < poles.size(); ++k) {
    // s = i w: 1 / (-alpha + i (w - beta)) in real arithmetic.
    const double alpha = poles[k].real(), beta = poles[k].imag();
    for (Eigen::Index i = 0; i < s.size(); ++i) {
      const double below = s[i].imag() - beta, above = s[i].imag() + beta;
      const double size = 1 / (alpha * alpha + below * below);
      const double size_conj = 1 / (alpha * alpha + above * above);
      phi(i, k) = Complex(-alpha * size, -below * size);
      phi_conj(i, k) = Complex(-alpha * size_conj, -above * size_conj);
    }
  }
}

PoleSums::PoleSums(const PoleValues& values, const Eigen::VectorXd& weight, bool with_squares)
    : values_(values) {
  first_ = values.phi.transpose() * weight;
  first_conj_ = values.phi_conj.transpose() * weight;
  if (!with_squares) return;
  second_.resize(values.pole.size());
  second_conj_.resize(values.pole.size());
  for (Eigen::Index k = 0; k < values.pole.size(); ++k) {
    second_[k] = (values.phi.col(k).array().square() * weight.array()).sum();
    second_conj_[k] = (values.phi_conj.col(k).array().square() * weight.array()).sum();
  }
}

Complex PoleSums::pole_of(const Function& g) const {
  return g.conjugate ? std::conj(values_.pole[g.pole]) : values_.pole[g.pole];
}

Complex PoleSums::sum(const Function& g, int order) const {
  if (order == 1) return g.conjugate ? first_conj_[g.pole] : first_[g.pole];
  return g.conjugate ? second_conj_[g.pole] : second_[g.pole];
}

Complex PoleSums::inner(const Function& a, const Function& b) const {
  const Complex inverse = 1.0 / (pole_of(b) + std::conj(pole_of(a)));
  const Complex zeroth = sum(b, 1) + std::conj(sum(a, 1));
  if (a.order == 1 && b.order == 1) return -zeroth * inverse;
  if (a.order == 1) return (-sum(b, 2) + zeroth * inverse) * inverse;
  if (b.order == 1) return (-std::conj(sum(a, 2)) + zeroth * inverse) * inverse;
  return (sum(b, 2) + std::conj(sum(a, 2)) - 2.0 * zeroth * inverse) * inverse * inverse;
}

}  // namespace stablecut
