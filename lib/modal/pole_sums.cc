#include "modal/pole_sums.h"

#include "base/wide.h"

namespace stablecut {

using Complex = std::complex<double>;

namespace {

// 1 / (-alpha + i (w - beta)) on the lines, as real and imaginary part in turn.
STABLECUT_WIDE void pole_on_lines(const double* __restrict omega, Eigen::Index lines, double alpha,
                                  double beta, double* __restrict value) {
  for (Eigen::Index i = 0; i < lines; ++i) {
    const double off = omega[i] - beta, size = 1 / (alpha * alpha + off * off);
    value[2 * i] = -alpha * size;
    value[2 * i + 1] = -off * size;
  }
}

// Sums of phi w, phi w h, phi w conj(h), phi w |h|^2 as real and imaginary parts. `lines` is a multiple of
// the lanes; the arrays hold w, Re w h, Im w h, w |h|^2.
STABLECUT_WIDE void sums_over_lines(const double* omega, const double* w, const double* re, const double* im,
                                    const double* square, Eigen::Index lines, double alpha, double beta,
                                    double* sums) {
  Lanes w_re{}, w_im{}, a_re{}, b_im{}, a_im{}, b_re{}, s_re{}, s_im{};
  for (Eigen::Index i = 0; i < lines; i += kLanes) {
    const Lanes off = load_lanes(omega + i) - beta;
    const Lanes size = -1 / (alpha * alpha + off * off);
    const Lanes a = alpha * size, b = off * size;
    const Lanes weight = load_lanes(w + i), x = load_lanes(re + i), y = load_lanes(im + i),
                v = load_lanes(square + i);
    w_re += a * weight;
    w_im += b * weight;
    a_re += a * x;
    b_im += b * y;
    a_im += a * y;
    b_re += b * x;
    s_re += a * v;
    s_im += b * v;
  }
  sums[0] = sum_of(w_re);
  sums[1] = sum_of(w_im);
  sums[2] = sum_of(a_re) - sum_of(b_im);
  sums[3] = sum_of(a_im) + sum_of(b_re);
  sums[4] = sum_of(a_re) + sum_of(b_im);
  sums[5] = sum_of(b_re) - sum_of(a_im);
  sums[6] = sum_of(s_re);
  sums[7] = sum_of(s_im);
}

}  // namespace

Eigen::Matrix<Complex, Eigen::Dynamic, 4> curve_sums(const Eigen::VectorXcd& s, const Eigen::VectorXcd& poles,
                                                     const Eigen::VectorXd& weight,
                                                     const Eigen::VectorXcd& h) {
  // Whole lanes: what is filled up has no weight.
  const Eigen::Index lines = (s.size() + kLanes - 1) / kLanes * kLanes, n = poles.size();
  Eigen::MatrixXd array = Eigen::MatrixXd::Zero(lines, 5);
  array.col(0).head(s.size()) = s.imag();
  array.col(1).head(s.size()) = weight;
  array.col(2).head(s.size()) = weight.cwiseProduct(h.real());
  array.col(3).head(s.size()) = weight.cwiseProduct(h.imag());
  array.col(4).head(s.size()) = weight.cwiseProduct(h.cwiseAbs2());
  Eigen::Matrix<Complex, Eigen::Dynamic, 4> sums(2 * n, 4);
  for (Eigen::Index k = 0; k < 2 * n; ++k) {
    const double beta = k < n ? poles[k].imag() : -poles[k - n].imag();
    double parts[8];
    sums_over_lines(array.col(0).data(), array.col(1).data(), array.col(2).data(), array.col(3).data(),
                    array.col(4).data(), lines, poles[k % n].real(), beta, parts);
    for (Eigen::Index c = 0; c < 4; ++c) sums(k, c) = {parts[2 * c], parts[2 * c + 1]};
  }
  return sums;
}

PoleValues::PoleValues(const Eigen::VectorXcd& s, const Eigen::VectorXcd& poles)
    : pole(poles), phi(s.size(), poles.size()), phi_conj(s.size(), poles.size()) {
  const Eigen::VectorXd omega = s.imag();
  for (Eigen::Index k = 0; k < poles.size(); ++k) {
    const auto fill = [&](double beta, Eigen::MatrixXcd& target) {
      pole_on_lines(omega.data(), omega.size(), poles[k].real(), beta,
                    reinterpret_cast<double*>(target.col(k).data()));
    };
    fill(poles[k].imag(), phi);
    fill(-poles[k].imag(), phi_conj);
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
