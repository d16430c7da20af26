#include "modal/likelihood.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>

#include "modal/pole_sums.h"

namespace stablecut::modal {
namespace {

using Complex = std::complex<double>;

// The prior of a mode outside the band: its damping -Re lambda / Im lambda, its place in band ends below or
// above the band, and the standard deviations of the logarithms of both.
constexpr double kPriorDamping = 0.05, kPriorDampingDeviation = 0.5;
constexpr double kPriorPlace = 1.5, kPriorPlaceDeviation = 1;
// What a mode outside the band makes of the curves at the band's nearer end, in multiples of what is measured
// there: standard deviation. Two modes that nearly cancel would leave nothing of J^T J's digits.
constexpr double kPriorSize = 3;
constexpr double kLeastPriorPlace = 1e-3;  // of the highest line, where the lowest is near 0
// What the factorization adds to a diagonal of 1; it grows by kRidgeGrowth until the matrix is positive
// definite, or it is 1.
constexpr double kNormalRidge = 1e-13, kRidgeGrowth = 100;

// How one complex coordinate of a mode moves one curve: by z it changes by z t g + conj(z t) g', where g is
// function f of the poles (phi of pole k has f = 2 k, its square f = 2 k + 1) and g' the same function of the
// conjugate pole.
struct CurveDerivative {
  Eigen::Index
      at;  // place of the coordinate's real part among all coordinates; the imaginary part is the next
  Eigen::Index f;
  Complex t;
};

std::vector<CurveDerivative> curve_derivatives(const ModeParameters& parameters, const Curve& curve,
                                               const std::vector<dynamics::Mode>& modes,
                                               const Eigen::VectorXcd& residue) {
  std::vector<CurveDerivative> derivatives;
  for (Eigen::Index k = 0; k < parameters.modes(); ++k) {
    const dynamics::Mode& mode = modes[k];
    const Eigen::Index first = k * parameters.coordinates_per_mode();
    derivatives.push_back({first, 2 * k + 1, residue[k]});
    derivatives.push_back({first + parameters.right_at(curve.response), 2 * k, mode.psi_l[curve.reference]});
    derivatives.push_back({first + parameters.left_at(curve.reference), 2 * k, mode.psi_r[curve.response]});
  }
  return derivatives;
}

void add_gradient(const std::vector<CurveDerivative>& derivatives, const ErrorPoleSums& sums,
                  Eigen::VectorXd& gradient) {
  const Eigen::Index n = sums.error.size() / 2;
  for (const CurveDerivative& d : derivatives) {
    const Eigen::VectorXcd& along = d.f % 2 == 0 ? sums.error : sums.error_squared;
    // Re(conj(t) a + t a') with a and a' the sums of the error along g and g', and the same with i t for t.
    const Complex own = std::conj(d.t) * along[d.f / 2], mirror = d.t * along[n + d.f / 2];
    gradient[d.at] += (own + mirror).real();
    gradient[d.at + 1] += (own - mirror).imag();
  }
}

// The four products of the real and imaginary parts of two coordinates, to the place (p, q) of J^T J and, if
// wanted, to its mirror image. The columns of J for a coordinate are t g + conj(t) g' and the same with i t
// for t; `same` ... `left` are conj(t g) (t g), conj(conj(t) g') (conj(t) g'), conj(t g) (conj(t) g') and
// conj(conj(t) g') (t g), summed over the lines with the weights between the two curves.
void add_products(const CurveDerivative& p, const CurveDerivative& q, Complex same, Complex both,
                  Complex right, Complex left, bool mirrored, Eigen::MatrixXd& matrix) {
  // t -> i t multiplies t by i and conj(t) by -i.
  const double re_re = (same + both + right + left).real(), im_im = (same + both - right - left).real(),
               re_im = (-same + both + right - left).imag(), im_re = (same - both + right - left).imag();
  matrix(p.at, q.at) += re_re;
  matrix(p.at, q.at + 1) += re_im;
  matrix(p.at + 1, q.at) += im_re;
  matrix(p.at + 1, q.at + 1) += im_im;
  if (!mirrored) return;
  matrix(q.at, p.at) += re_re;
  matrix(q.at + 1, p.at) += re_im;
  matrix(q.at, p.at + 1) += im_re;
  matrix(q.at + 1, p.at + 1) += im_im;
}

// J^T J of one curve.
void add_matrix(const std::vector<CurveDerivative>& derivatives, const PoleGrams& grams,
                Eigen::MatrixXd& matrix) {
  for (std::size_t a = 0; a < derivatives.size(); ++a) {
    for (std::size_t b = a; b < derivatives.size(); ++b) {
      const CurveDerivative &p = derivatives[a], &q = derivatives[b];
      add_products(p, q, std::conj(p.t) * q.t * grams.same(p.f, q.f),
                   p.t * std::conj(q.t) * grams.mirrored(p.f, q.f),
                   std::conj(p.t) * std::conj(q.t) * grams.across(p.f, q.f),
                   p.t * q.t * std::conj(grams.across(q.f, p.f)), a != b, matrix);
    }
  }
}

// What correlated errors of two curves add to J^T J.
void add_matrix(const std::vector<CurveDerivative>& first, const std::vector<CurveDerivative>& second,
                const PoleGrams& grams, Eigen::MatrixXd& matrix) {
  for (const CurveDerivative& p : first) {
    for (const CurveDerivative& q : second) {
      add_products(p, q, std::conj(p.t) * q.t * grams.same(p.f, q.f),
                   p.t * std::conj(q.t) * grams.mirrored(p.f, q.f),
                   std::conj(p.t) * std::conj(q.t) * grams.across(p.f, q.f), p.t * q.t * grams.back(p.f, q.f),
                   true, matrix);
    }
  }
}

// Root mean square of each curve's lowest and highest octave; of curves of zeros that of the largest one.
Eigen::Matrix2Xd end_sizes(const FitData& data) {
  const Eigen::VectorXd omega = data.s.imag();
  const auto octave = [&](double from, double to) {
    return ((omega.array() >= from) && (omega.array() <= to)).cast<double>().eval();
  };
  const Eigen::ArrayXd low = octave(data.lowest(), 2 * data.lowest()),
                       high = octave(data.highest() / 2, data.highest());
  Eigen::Matrix2Xd sizes(2, data.curves.size());
  for (Eigen::Index c = 0; c < sizes.cols(); ++c) {
    const Eigen::ArrayXd square = data.curves[c].h.array().abs2();
    sizes.col(c) << std::sqrt((square * low).sum() / low.sum()),
        std::sqrt((square * high).sum() / high.sum());
  }
  for (Eigen::Index end = 0; end < 2; ++end) {
    const double largest = sizes.row(end).maxCoeff();
    sizes.row(end) = (sizes.row(end).array() > 0).select(sizes.row(end), largest);
  }
  return sizes;
}

// From the coordinates of the table to the free parameters: their Jacobian is block diagonal.
NormalEquations to_parameters(const ModeParameters& parameters, const Eigen::Ref<const Eigen::VectorXd>& x,
                              const NormalEquations& coordinates) {
  NormalEquations result{coordinates.sum_of_squares, Eigen::VectorXd(parameters.size()),
                         Eigen::MatrixXd(parameters.size(), parameters.size())};
  const Eigen::Index from = parameters.coordinates_per_mode(), to = parameters.per_mode();
  std::vector<Eigen::MatrixXd> slope;
  for (Eigen::Index k = 0; k < parameters.modes(); ++k) slope.push_back(parameters.slope(x, k));
  for (Eigen::Index k = 0; k < parameters.modes(); ++k) {
    const Eigen::MatrixXd left = slope[k].transpose();
    result.gradient.segment(k * to, to) = left * coordinates.gradient.segment(k * from, from);
    const Eigen::MatrixXd rows = left * coordinates.matrix.middleRows(k * from, from);
    for (Eigen::Index j = 0; j < parameters.modes(); ++j) {
      result.matrix.block(k * to, j * to, to, to) = rows.middleCols(j * from, from) * slope[j];
    }
  }
  return result;
}

}  // namespace

Likelihood::Likelihood(const FitData& data, const ModeParameters& parameters, std::vector<bool> out_of_band)
    : data_(data), parameters_(parameters), residual_(data), out_of_band_(std::move(out_of_band)) {
  if (std::find(out_of_band_.begin(), out_of_band_.end(), true) != out_of_band_.end())
    sizes_ = end_sizes(data);
}

NormalEquations Likelihood::evaluate(const Eigen::Ref<const Eigen::VectorXd>& x, bool with_matrix) const {
  NormalEquations sums;
  if (with_matrix) {
    const Eigen::Index size = parameters_.modes() * parameters_.coordinates_per_mode();
    sums.gradient = Eigen::VectorXd::Zero(size);
    sums.matrix = Eigen::MatrixXd::Zero(size, size);
  }
  const std::vector<dynamics::Mode> modes = parameters_.unpack(x);
  Eigen::VectorXcd poles(parameters_.modes());
  for (Eigen::Index k = 0; k < poles.size(); ++k) poles[k] = parameters_.pole(x, k);
  Eigen::MatrixXcd residue(poles.size(), data_.curves.size());
  for (Eigen::Index c = 0; c < residue.cols(); ++c) {
    const Curve& curve = data_.curves[c];
    for (Eigen::Index k = 0; k < poles.size(); ++k) {
      const dynamics::Mode& mode = modes[k];
      residue(k, c) = mode.psi_r[curve.response] * mode.psi_l[curve.reference];
    }
  }
  PoleSums over_lines;
  sums.sum_of_squares = residual_.evaluate(poles, residue, with_matrix ? &over_lines : nullptr);
  if (with_matrix) {
    PoleGrams grams(poles);
    std::vector<std::vector<CurveDerivative>> derivatives;
    for (std::size_t c = 0; c < over_lines.curves.size(); ++c) {
      const ErrorPoleSums& of_curve = over_lines.curves[c];
      derivatives.push_back(curve_derivatives(parameters_, data_.curves[c], modes, residue.col(c)));
      grams.evaluate(of_curve.weight, of_curve.weight_squared);
      add_gradient(derivatives[c], of_curve, sums.gradient);
      add_matrix(derivatives[c], grams, sums.matrix);
    }
    for (const PairPoleSums& pair : over_lines.pairs) {
      grams.evaluate(pair.weight, pair.weight_squared, pair.mirror, pair.mirror_squared);
      add_matrix(derivatives[pair.first], derivatives[pair.second], grams, sums.matrix);
    }
  }
  add_size_priors(modes, sums, with_matrix);
  NormalEquations result = with_matrix ? to_parameters(parameters_, x, sums) : std::move(sums);
  add_priors(x, with_matrix, result);
  if (with_matrix) hold_poles(x, result);
  return result;
}

// No slope along the parameters of poles that stay, and none of the others' information.
void Likelihood::hold_poles(const Eigen::Ref<const Eigen::VectorXd>& x, NormalEquations& result) const {
  for (Eigen::Index k = 0; k < parameters_.modes(); ++k) {
    if (!data_.holds(parameters_.pole(x, k))) continue;
    for (const Eigen::Index at : {parameters_.pole_at(k), parameters_.pole_at(k) + 1}) {
      result.gradient[at] = 0;
      result.matrix.row(at).setZero();
      result.matrix.col(at).setZero();
      result.matrix(at, at) = 1;
    }
  }
}

// The curves may not tell damping and distance of a mode outside the band: then a usual damping and a place
// near the band hold, so that a stability chart does not find it chatter. Where the curves tell, they
// outweigh this.
void Likelihood::add_priors(const Eigen::Ref<const Eigen::VectorXd>& x, bool with_matrix,
                            NormalEquations& result) const {
  const double lo = data_.lowest(), hi = data_.highest();
  const auto add = [&](Eigen::Index at, double expected, double deviation) {
    const double off = (x[at] - expected) / deviation;
    result.sum_of_squares += off * off / 2;
    if (!with_matrix) return;
    result.gradient[at] += off / deviation / 2;
    result.matrix(at, at) += 1 / (2 * deviation * deviation);
  };
  for (Eigen::Index k = 0; k < parameters_.modes(); ++k) {
    if (!out_of_band_[k]) continue;
    const Eigen::Index at = parameters_.pole_at(k);
    add(at, std::log(kPriorDamping), kPriorDampingDeviation);
    const bool above = x[at + 1] > std::log(hi);
    add(at + 1,
        above ? std::log(kPriorPlace * hi) : std::log(std::max(lo / kPriorPlace, kLeastPriorPlace * hi)),
        kPriorPlaceDeviation);
  }
}

void Likelihood::add_size_priors(const std::vector<dynamics::Mode>& modes, NormalEquations& coordinates,
                                 bool with_matrix) const {
  Eigen::VectorXcd slope = Eigen::VectorXcd::Zero(parameters_.coordinates_per_mode());
  for (std::size_t k = 0; k < modes.size(); ++k) {
    if (!out_of_band_[k]) continue;
    const Complex pole = modes[k].pole();
    const bool above = pole.imag() > data_.highest();
    const Complex s(0, above ? data_.highest() : data_.lowest());
    const Complex own = 1.0 / (s - pole), mirror = 1.0 / (s - std::conj(pole));
    const auto first = static_cast<Eigen::Index>(k) * slope.size();
    for (std::size_t c = 0; c < data_.curves.size(); ++c) {
      const Curve& curve = data_.curves[c];
      const Complex right = modes[k].psi_r[curve.response], left = modes[k].psi_l[curve.reference];
      const double weight = std::pow(kPriorSize * sizes_(above, static_cast<Eigen::Index>(c)), -2);
      const Complex made = right * left * own + std::conj(right * left) * mirror;
      coordinates.sum_of_squares += weight * std::norm(made);
      if (!with_matrix) continue;
      // By z of a coordinate it changes by z t g + conj(z t) g'.
      slope.setZero();
      const auto add = [&](Eigen::Index at, Complex t, Complex g, Complex g_mirror) {
        slope[at] = t * g + std::conj(t) * g_mirror;
        slope[at + 1] = Complex(0, 1) * (t * g - std::conj(t) * g_mirror);
      };
      add(0, right * left, own * own, mirror * mirror);
      add(parameters_.right_at(curve.response), left, own, mirror);
      add(parameters_.left_at(curve.reference), right, own, mirror);
      coordinates.gradient.segment(first, slope.size()) += weight * (slope.conjugate() * made).real();
      coordinates.matrix.block(first, first, slope.size(), slope.size()) +=
          weight * (slope.conjugate() * slope.transpose()).real();
    }
  }
}

std::vector<bool> out_of_band(const FitData& data, const std::vector<dynamics::Mode>& modes) {
  std::vector<bool> result;
  for (const dynamics::Mode& mode : modes) result.push_back(!data.in_band(mode.pole()));
  return result;
}

// In units in which the diagonal is 1: what nearly nothing tells of one mode leaves the others as they are.
Eigen::MatrixXd inverse_normal_matrix(const NormalEquations& normal) {
  const Eigen::ArrayXd diagonal = normal.matrix.diagonal().array();
  const Eigen::VectorXd unit = (diagonal > 0).select(diagonal.sqrt().inverse(), 1.0);
  const Eigen::MatrixXd scaled = unit.asDiagonal() * normal.matrix * unit.asDiagonal(),
                        identity = Eigen::MatrixXd::Identity(scaled.rows(), scaled.rows());
  for (double ridge = kNormalRidge;; ridge *= kRidgeGrowth) {
    const Eigen::LLT<Eigen::MatrixXd> factor(scaled + ridge * identity);
    if (factor.info() == Eigen::Success || ridge > 1)
      return unit.asDiagonal() * factor.solve(identity) * unit.asDiagonal();
  }
}

}  // namespace stablecut::modal
