#include "modal/residual_sums.h"

#include <algorithm>
#include <complex>

#include "numerics/lanes.h"

namespace stablecut::modal {
namespace {

using Complex = std::complex<double>;

constexpr Eigen::Index kBlock = 128;  // lines at a time; whole lanes

// phi of a pole on the lines.
STABLECUT_WIDE void pole_on_lanes(const double* omega, Eigen::Index lines, double alpha, double beta,
                                  double* re, double* im) {
  for (Eigen::Index i = 0; i < lines; i += numerics::kLanes) {
    const numerics::Lanes off = numerics::load_lanes(omega + i) - beta;
    const numerics::Lanes size = -1 / (alpha * alpha + off * off);
    numerics::store_lanes(alpha * size, re + i);
    numerics::store_lanes(off * size, im + i);
  }
}

// Adds residue times phi to the model, in separate parts.
STABLECUT_WIDE void add_product(const double* phi_re, const double* phi_im, Eigen::Index lines, double re,
                                double im, double* model_re, double* model_im) {
  for (Eigen::Index i = 0; i < lines; i += numerics::kLanes) {
    const numerics::Lanes x = numerics::load_lanes(phi_re + i), y = numerics::load_lanes(phi_im + i);
    numerics::store_lanes(numerics::load_lanes(model_re + i) + (re * x - im * y), model_re + i);
    numerics::store_lanes(numerics::load_lanes(model_im + i) + (re * y + im * x), model_im + i);
  }
}

// Turns the model into w (model - h), and gives sum w |model - h|^2.
STABLECUT_WIDE double weigh_error(const double* h_re, const double* h_im, const double* weight,
                                  Eigen::Index lines, double* re, double* im) {
  numerics::Lanes sum{};
  for (Eigen::Index i = 0; i < lines; i += numerics::kLanes) {
    const numerics::Lanes w = numerics::load_lanes(weight + i);
    const numerics::Lanes x = numerics::load_lanes(re + i) - numerics::load_lanes(h_re + i),
                          y = numerics::load_lanes(im + i) - numerics::load_lanes(h_im + i);
    sum += w * (x * x + y * y);
    numerics::store_lanes(w * x, re + i);
    numerics::store_lanes(w * y, im + i);
  }
  return numerics::sum_of(sum);
}

// Adds to the eight parts of a curve's sums for one phi.
STABLECUT_WIDE void add_sums(const double* phi_re, const double* phi_im, const double* weight,
                             const double* error_re, const double* error_im, Eigen::Index lines,
                             double* sums) {
  numerics::Lanes w_re{}, w_im{}, q_re{}, q_im{}, e_re{}, e_im{}, s_re{}, s_im{};
  for (Eigen::Index i = 0; i < lines; i += numerics::kLanes) {
    const numerics::Lanes x = numerics::load_lanes(phi_re + i), y = numerics::load_lanes(phi_im + i);
    const numerics::Lanes u = x * x - y * y, xy = x * y, v = xy + xy;
    const numerics::Lanes w = numerics::load_lanes(weight + i), a = numerics::load_lanes(error_re + i),
                          b = numerics::load_lanes(error_im + i);
    w_re += w * x;
    w_im += w * y;
    q_re += w * u;
    q_im += w * v;
    e_re += x * a + y * b;
    e_im += x * b - y * a;
    s_re += u * a + v * b;
    s_im += u * b - v * a;
  }
  sums[0] += numerics::sum_of(w_re);
  sums[1] += numerics::sum_of(w_im);
  sums[2] += numerics::sum_of(q_re);
  sums[3] += numerics::sum_of(q_im);
  sums[4] += numerics::sum_of(e_re);
  sums[5] += numerics::sum_of(e_im);
  sums[6] += numerics::sum_of(s_re);
  sums[7] += numerics::sum_of(s_im);
}

}  // namespace

ResidualSums::ResidualSums(const FitData& data) : curves_(data.curves.size()) {
  const Eigen::Index lines = (data.lines() + numerics::kLanes - 1) / numerics::kLanes * numerics::kLanes;
  omega_ = Eigen::ArrayXd::Zero(lines);
  omega_.head(data.lines()) = data.s.imag();
  weight_ = h_re_ = h_im_ = Eigen::ArrayXXd::Zero(lines, curves_);
  for (Eigen::Index c = 0; c < curves_; ++c) {
    const Curve& curve = data.curves[c];
    weight_.col(c).head(data.lines()) = curve.weight;
    h_re_.col(c).head(data.lines()) = curve.h.real();
    h_im_.col(c).head(data.lines()) = curve.h.imag();
  }
}

double ResidualSums::evaluate(const Eigen::VectorXcd& poles, const Eigen::MatrixXcd& residue,
                              std::vector<ErrorPoleSums>* sums) const {
  const Eigen::Index n = poles.size();
  Eigen::ArrayXXd phi_re(kBlock, 2 * n), phi_im(kBlock, 2 * n), error_re(kBlock, curves_),
      error_im(kBlock, curves_);
  // Eight parts for each function of each curve.
  Eigen::MatrixXd parts = Eigen::MatrixXd::Zero(8, sums == nullptr ? 0 : 2 * n * curves_);
  double chi_square = 0;
  for (Eigen::Index first = 0; first < omega_.size(); first += kBlock) {
    const Eigen::Index lines = std::min(kBlock, omega_.size() - first);
    for (Eigen::Index f = 0; f < 2 * n; ++f) {
      const double beta = f < n ? poles[f].imag() : -poles[f - n].imag();
      pole_on_lanes(&omega_[first], lines, poles[f % n].real(), beta, &phi_re(0, f), &phi_im(0, f));
    }
    error_re.setZero();
    error_im.setZero();
    for (Eigen::Index c = 0; c < curves_; ++c) {
      for (Eigen::Index f = 0; f < 2 * n; ++f) {
        const Complex r = f < n ? residue(f, c) : std::conj(residue(f - n, c));
        add_product(&phi_re(0, f), &phi_im(0, f), lines, r.real(), r.imag(), &error_re(0, c),
                    &error_im(0, c));
      }
      chi_square += weigh_error(&h_re_(first, c), &h_im_(first, c), &weight_(first, c), lines,
                                &error_re(0, c), &error_im(0, c));
      if (sums == nullptr) continue;
      for (Eigen::Index f = 0; f < 2 * n; ++f) {
        add_sums(&phi_re(0, f), &phi_im(0, f), &weight_(first, c), &error_re(0, c), &error_im(0, c), lines,
                 &parts(0, c * 2 * n + f));
      }
    }
  }
  if (sums == nullptr) return chi_square;
  sums->clear();
  for (Eigen::Index c = 0; c < curves_; ++c) {
    const auto part = [&](Eigen::Index row) -> Eigen::VectorXcd {
      const auto columns = parts.middleCols(c * 2 * n, 2 * n);
      return columns.row(row).transpose().cast<Complex>() + Complex(0, 1) * columns.row(row + 1).transpose();
    };
    sums->push_back({part(0), part(2), part(4), part(6)});
  }
  return chi_square;
}

}  // namespace stablecut::modal
