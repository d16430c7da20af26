#include "modal/residual_sums.h"

#include <algorithm>
#include <complex>

#include "modal/error_weights.h"
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

// Adds a pole pair to the models of all curves, in separate parts: R phi + conj(R) phi' with phi' of the
// conjugate pole is Re R (phi + phi') + i Im R (phi - phi').
STABLECUT_WIDE void add_pole_pair_on_lanes(const double* phi_re, const double* phi_im,
                                           const double* mirror_re, const double* mirror_im,
                                           Eigen::Index lines, const std::complex<double>* residue,
                                           Eigen::Index curves, double* model_re, double* model_im) {
  for (Eigen::Index i = 0; i < lines; i += numerics::kLanes) {
    const numerics::Lanes x = numerics::load_lanes(phi_re + i), y = numerics::load_lanes(phi_im + i),
                          u = numerics::load_lanes(mirror_re + i), v = numerics::load_lanes(mirror_im + i);
    const numerics::Lanes sum_re = x + u, sum_im = y + v, turned_re = v - y, turned_im = x - u;
    for (Eigen::Index c = 0; c < curves; ++c) {
      const double re = residue[c].real(), im = residue[c].imag();
      double *to_re = model_re + c * kBlock + i, *to_im = model_im + c * kBlock + i;
      numerics::store_lanes(numerics::load_lanes(to_re) + (re * sum_re + im * turned_re), to_re);
      numerics::store_lanes(numerics::load_lanes(to_im) + (re * sum_im + im * turned_im), to_im);
    }
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

// Adds conj(common) times the weighted error of one curve to what its column shares.
STABLECUT_WIDE void add_along(const double* common_re, const double* common_im, const double* error_re,
                              const double* error_im, Eigen::Index lines, double* re, double* im) {
  for (Eigen::Index i = 0; i < lines; i += numerics::kLanes) {
    const numerics::Lanes x = numerics::load_lanes(common_re + i), y = numerics::load_lanes(common_im + i),
                          a = numerics::load_lanes(error_re + i), b = numerics::load_lanes(error_im + i);
    numerics::store_lanes(numerics::load_lanes(re + i) + (x * a + y * b), re + i);
    numerics::store_lanes(numerics::load_lanes(im + i) + (x * b - y * a), im + i);
  }
}

// Takes own common z off the weighted error of one curve.
STABLECUT_WIDE void take_along(const double* common_re, const double* common_im, const double* own,
                               const double* re, const double* im, Eigen::Index lines, double* error_re,
                               double* error_im) {
  for (Eigen::Index i = 0; i < lines; i += numerics::kLanes) {
    const numerics::Lanes x = numerics::load_lanes(common_re + i), y = numerics::load_lanes(common_im + i),
                          a = numerics::load_lanes(re + i), b = numerics::load_lanes(im + i),
                          w = numerics::load_lanes(own + i);
    numerics::store_lanes(numerics::load_lanes(error_re + i) - w * (x * a - y * b), error_re + i);
    numerics::store_lanes(numerics::load_lanes(error_im + i) - w * (x * b + y * a), error_im + i);
  }
}

STABLECUT_WIDE double sum_of_squares(const double* re, const double* im, Eigen::Index lines) {
  numerics::Lanes sum{};
  for (Eigen::Index i = 0; i < lines; i += numerics::kLanes) {
    const numerics::Lanes x = numerics::load_lanes(re + i), y = numerics::load_lanes(im + i);
    sum += x * x + y * y;
  }
  return numerics::sum_of(sum);
}

// Adds parts to sums that are kept in lanes, one behind the other.
template <typename... Parts>
STABLECUT_INLINE void add_lanes(double* sums, const Parts&... parts) {
  ((numerics::store_lanes(numerics::load_lanes(sums) + parts, sums), sums += numerics::kLanes), ...);
}

// Adds to the eight parts of a pair's sums for one phi: phi and its square, with both parts of the weight.
STABLECUT_WIDE void add_pair_sums(const double* phi_re, const double* phi_im, const double* weight_re,
                                  const double* weight_im, Eigen::Index lines, double* sums) {
  numerics::Lanes a_re{}, a_im{}, b_re{}, b_im{}, c_re{}, c_im{}, d_re{}, d_im{};
  for (Eigen::Index i = 0; i < lines; i += numerics::kLanes) {
    const numerics::Lanes x = numerics::load_lanes(phi_re + i), y = numerics::load_lanes(phi_im + i);
    const numerics::Lanes u = x * x - y * y, xy = x * y, v = xy + xy;
    const numerics::Lanes p = numerics::load_lanes(weight_re + i), q = numerics::load_lanes(weight_im + i);
    a_re += p * x;
    a_im += p * y;
    b_re += p * u;
    b_im += p * v;
    c_re += q * x;
    c_im += q * y;
    d_re += q * u;
    d_im += q * v;
  }
  add_lanes(sums, a_re, a_im, b_re, b_im, c_re, c_im, d_re, d_im);
}

// Complex numbers from two rows of a matrix.
Eigen::VectorXcd complex_row(const Eigen::MatrixXd& parts, Eigen::Index row, Eigen::Index first,
                             Eigen::Index count) {
  const auto columns = parts.middleCols(first, count);
  return columns.row(row).transpose().cast<Complex>() + Complex(0, 1) * columns.row(row + 1).transpose();
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
  add_lanes(sums, w_re, w_im, q_re, q_im, e_re, e_im, s_re, s_im);
}

}  // namespace

ResidualSums::ResidualSums(const FitData& data)
    : curves_(data.curves.size()), columns_(data.dofs), pairs_(correlated_pairs(data)) {
  const Eigen::Index lines = (data.lines() + numerics::kLanes - 1) / numerics::kLanes * numerics::kLanes;
  omega_ = Eigen::ArrayXd::Zero(lines);
  omega_.head(data.lines()) = data.s.imag();
  own_ = diagonal_ = h_re_ = h_im_ = Eigen::ArrayXXd::Zero(lines, curves_);
  const std::vector<ErrorWeights> weights = error_weights(data);
  if (!pairs_.empty()) common_re_ = common_im_ = Eigen::ArrayXXd::Zero(lines, curves_);
  for (Eigen::Index c = 0; c < curves_; ++c) {
    const Curve& curve = data.curves[c];
    own_.col(c).head(data.lines()) = weights[c].own;
    diagonal_.col(c).head(data.lines()) = weights[c].diagonal();
    h_re_.col(c).head(data.lines()) = curve.h.real();
    h_im_.col(c).head(data.lines()) = curve.h.imag();
    if (weights[c].common.size() == 0) continue;
    columns_[curve.reference].curves.push_back(c);
    common_re_.col(c).head(data.lines()) = weights[c].common.real();
    common_im_.col(c).head(data.lines()) = weights[c].common.imag();
  }
  std::erase_if(columns_, [](const Column& column) { return column.curves.empty(); });
  pair_re_ = pair_im_ = Eigen::ArrayXXd::Zero(lines, pairs_.size());
  for (std::size_t p = 0; p < pairs_.size(); ++p) {
    const ErrorWeights &a = weights[pairs_[p].first], &b = weights[pairs_[p].second];
    const Eigen::ArrayXcd weight =
        -(a.own.array() * b.own.array()) * a.common.array() * b.common.array().conjugate();
    const Eigen::Index at = p;
    pair_re_.col(at).head(data.lines()) = weight.real();
    pair_im_.col(at).head(data.lines()) = weight.imag();
  }
}

// Takes what each column shares off the weighted errors, and gives by how much chi-square is less for it.
double ResidualSums::take_shared(Eigen::Index first, Eigen::Index lines, Eigen::ArrayXXd& error_re,
                                 Eigen::ArrayXXd& error_im) const {
  double less = 0;
  Eigen::ArrayXd re(kBlock), im(kBlock);
  for (const Column& column : columns_) {
    re.setZero();
    im.setZero();
    for (const Eigen::Index c : column.curves) {
      add_along(&common_re_(first, c), &common_im_(first, c), &error_re(0, c), &error_im(0, c), lines,
                re.data(), im.data());
    }
    less += sum_of_squares(re.data(), im.data(), lines);
    for (const Eigen::Index c : column.curves) {
      take_along(&common_re_(first, c), &common_im_(first, c), &own_(first, c), re.data(), im.data(), lines,
                 &error_re(0, c), &error_im(0, c));
    }
  }
  return less;
}

double ResidualSums::evaluate(const Eigen::VectorXcd& poles, const Eigen::MatrixXcd& residue,
                              PoleSums* sums) const {
  const Eigen::Index n = poles.size(), pairs = pair_re_.cols();
  Eigen::ArrayXXd phi_re(kBlock, 2 * n), phi_im(kBlock, 2 * n), error_re(kBlock, curves_),
      error_im(kBlock, curves_);
  const Eigen::MatrixXcd by_pole = residue.transpose();
  // Eight parts for each function of each curve, and of each pair; each in lanes, to be added up at the end.
  Eigen::MatrixXd in_lanes =
      Eigen::MatrixXd::Zero(8 * numerics::kLanes, sums == nullptr ? 0 : 2 * n * (curves_ + pairs));
  double chi_square = 0;
  for (Eigen::Index first = 0; first < omega_.size(); first += kBlock) {
    const Eigen::Index lines = std::min(kBlock, omega_.size() - first);
    for (Eigen::Index f = 0; f < 2 * n; ++f) {
      const double beta = f < n ? poles[f].imag() : -poles[f - n].imag();
      pole_on_lanes(&omega_[first], lines, poles[f % n].real(), beta, &phi_re(0, f), &phi_im(0, f));
    }
    error_re.setZero();
    error_im.setZero();
    for (Eigen::Index k = 0; k < n; ++k) {
      add_pole_pair_on_lanes(&phi_re(0, k), &phi_im(0, k), &phi_re(0, n + k), &phi_im(0, n + k), lines,
                             &by_pole(0, k), curves_, error_re.data(), error_im.data());
    }
    for (Eigen::Index c = 0; c < curves_; ++c) {
      chi_square += weigh_error(&h_re_(first, c), &h_im_(first, c), &own_(first, c), lines, &error_re(0, c),
                                &error_im(0, c));
    }
    chi_square -= take_shared(first, lines, error_re, error_im);
    if (sums == nullptr) continue;
    for (Eigen::Index f = 0; f < 2 * n; ++f) {
      for (Eigen::Index c = 0; c < curves_; ++c) {
        add_sums(&phi_re(0, f), &phi_im(0, f), &diagonal_(first, c), &error_re(0, c), &error_im(0, c), lines,
                 &in_lanes(0, c * 2 * n + f));
      }
      for (Eigen::Index p = 0; p < pairs; ++p) {
        add_pair_sums(&phi_re(0, f), &phi_im(0, f), &pair_re_(first, p), &pair_im_(first, p), lines,
                      &in_lanes(0, (curves_ + p) * 2 * n + f));
      }
    }
  }
  if (sums == nullptr) return chi_square;
  Eigen::MatrixXd parts(8, in_lanes.cols());
  for (Eigen::Index f = 0; f < parts.cols(); ++f)
    for (Eigen::Index part = 0; part < parts.rows(); ++part)
      parts(part, f) = numerics::sum_of(numerics::load_lanes(&in_lanes(part * numerics::kLanes, f)));
  *sums = {};
  const auto part = [&](Eigen::Index which, Eigen::Index row) {
    return complex_row(parts, row, which * 2 * n, 2 * n);
  };
  for (Eigen::Index c = 0; c < curves_; ++c)
    sums->curves.push_back({part(c, 0), part(c, 2), part(c, 4), part(c, 6)});
  const Complex i(0, 1);
  for (Eigen::Index p = 0; p < pairs; ++p) {
    const Eigen::VectorXcd re = part(curves_ + p, 0), re_squared = part(curves_ + p, 2),
                           im = part(curves_ + p, 4), im_squared = part(curves_ + p, 6);
    sums->pairs.push_back({pairs_[p].first, pairs_[p].second, re + i * im, re_squared + i * im_squared,
                           re - i * im, re_squared - i * im_squared});
  }
  return chi_square;
}

}  // namespace stablecut::modal
