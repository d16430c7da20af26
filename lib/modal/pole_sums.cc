#include "modal/pole_sums.h"

#include "numerics/lanes.h"

namespace stablecut::modal {

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

// s and h as real and imaginary part in turn.
STABLECUT_WIDE void add_pair(const double* __restrict s, Eigen::Index lines, double alpha, double beta,
                             double re, double im, double* __restrict h) {
  // Sums only: of a sum beside a difference GCC 12 makes fused multiply-adds, whatever -ffp-contract says.
  const double minus_re = -re, minus_im = -im;
  for (Eigen::Index i = 0; i < lines; ++i) {
    const double below = s[2 * i + 1] - beta, above = s[2 * i + 1] + beta;
    const double size = 1 / (alpha * alpha + below * below), mirrored = 1 / (alpha * alpha + above * above);
    // (re + i im) (alpha - i below) size + (re - i im) (alpha - i above) mirrored.
    h[2 * i] += size * (re * alpha + im * below) + mirrored * (re * alpha + minus_im * above);
    h[2 * i + 1] += size * (im * alpha + minus_re * below) + mirrored * (minus_im * alpha + minus_re * above);
  }
}

// Sums of phi w, phi w h, phi w conj(h), phi w |h|^2 as real and imaginary parts. `lines` is a multiple of
// the lanes; the arrays hold w, Re w h, Im w h, w |h|^2.
STABLECUT_WIDE void sums_over_lines(const double* omega, const double* w, const double* re, const double* im,
                                    const double* square, Eigen::Index lines, double alpha, double beta,
                                    double* sums) {
  numerics::Lanes w_re{}, w_im{}, a_re{}, b_im{}, a_im{}, b_re{}, s_re{}, s_im{};
  for (Eigen::Index i = 0; i < lines; i += numerics::kLanes) {
    const numerics::Lanes off = numerics::load_lanes(omega + i) - beta;
    const numerics::Lanes size = -1 / (alpha * alpha + off * off);
    const numerics::Lanes a = alpha * size, b = off * size;
    const numerics::Lanes weight = numerics::load_lanes(w + i), x = numerics::load_lanes(re + i),
                          y = numerics::load_lanes(im + i), v = numerics::load_lanes(square + i);
    w_re += a * weight;
    w_im += b * weight;
    a_re += a * x;
    b_im += b * y;
    a_im += a * y;
    b_re += b * x;
    s_re += a * v;
    s_im += b * v;
  }
  sums[0] = numerics::sum_of(w_re);
  sums[1] = numerics::sum_of(w_im);
  sums[2] = numerics::sum_of(a_re) - numerics::sum_of(b_im);
  sums[3] = numerics::sum_of(a_im) + numerics::sum_of(b_re);
  sums[4] = numerics::sum_of(a_re) + numerics::sum_of(b_im);
  sums[5] = numerics::sum_of(b_re) - numerics::sum_of(a_im);
  sums[6] = numerics::sum_of(s_re);
  sums[7] = numerics::sum_of(s_im);
}

}  // namespace

Eigen::Matrix<Complex, Eigen::Dynamic, 4> data_pole_sums(const Eigen::VectorXcd& s,
                                                         const Eigen::VectorXcd& poles,
                                                         const Eigen::VectorXd& weight,
                                                         const Eigen::VectorXcd& h) {
  // Whole lanes: what is filled up has no weight.
  const Eigen::Index lines = (s.size() + numerics::kLanes - 1) / numerics::kLanes * numerics::kLanes,
                     n = poles.size();
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

void add_pole_pair(const Eigen::VectorXcd& s, Complex pole, Complex residue, Eigen::VectorXcd& h) {
  add_pair(reinterpret_cast<const double*>(s.data()), s.size(), -pole.real(), pole.imag(), residue.real(),
           residue.imag(), reinterpret_cast<double*>(h.data()));
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

PoleGrams::PoleGrams(const Eigen::VectorXcd& poles) : poles_(poles.size()), inverse_(2 * poles_, 2 * poles_) {
  Eigen::VectorXcd pole(2 * poles_);
  pole << poles, poles.conjugate();
  for (Eigen::Index b = 0; b < 2 * poles_; ++b) {
    for (Eigen::Index a = 0; a < 2 * poles_; ++a) inverse_(a, b) = 1.0 / (pole[b] + std::conj(pole[a]));
  }
  same.resize(2 * poles_, 2 * poles_);
  mirrored = across = same;
}

void PoleGrams::fill(const Eigen::VectorXcd& sum, const Eigen::VectorXcd& sum_squared,
                     const Eigen::VectorXcd& mirror, const Eigen::VectorXcd& mirror_squared, Eigen::Index row,
                     Eigen::Index column, Eigen::MatrixXcd& gram) const {
  for (Eigen::Index j = 0; j < poles_; ++j) {
    for (Eigen::Index i = 0; i < poles_; ++i) {
      const Eigen::Index a = row + i, b = column + j;
      const Complex inverse = inverse_(a, b), of_b = sum_squared[b], of_a = std::conj(mirror_squared[a]);
      const Complex zeroth = (sum[b] + std::conj(mirror[a])) * inverse;
      gram(2 * i, 2 * j) = -zeroth;
      gram(2 * i, 2 * j + 1) = (zeroth - of_b) * inverse;
      gram(2 * i + 1, 2 * j) = (zeroth - of_a) * inverse;
      gram(2 * i + 1, 2 * j + 1) = (of_b + of_a - 2.0 * zeroth) * inverse * inverse;
    }
  }
}

void PoleGrams::evaluate(const Eigen::VectorXcd& sum, const Eigen::VectorXcd& sum_squared) {
  fill(sum, sum_squared, sum, sum_squared, 0, 0, same);
  fill(sum, sum_squared, sum, sum_squared, poles_, poles_, mirrored);
  fill(sum, sum_squared, sum, sum_squared, 0, poles_, across);
}

void PoleGrams::evaluate(const Eigen::VectorXcd& sum, const Eigen::VectorXcd& sum_squared,
                         const Eigen::VectorXcd& mirror, const Eigen::VectorXcd& mirror_squared) {
  back.resize(2 * poles_, 2 * poles_);
  fill(sum, sum_squared, mirror, mirror_squared, 0, 0, same);
  fill(sum, sum_squared, mirror, mirror_squared, poles_, poles_, mirrored);
  fill(sum, sum_squared, mirror, mirror_squared, 0, poles_, across);
  fill(sum, sum_squared, mirror, mirror_squared, poles_, 0, back);
}

}  // namespace stablecut::modal
