#include "modal/mode_candidates.h"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "modal/error_weights.h"
#include "modal/maximum_likelihood.h"
#include "numerics/lanes.h"

namespace stablecut::modal {
namespace {

using Complex = std::complex<double>;

constexpr double kDampings[] = {0.004, 0.02, 0.08, 0.3};  // damping ratios that are tried
constexpr double kOutsideDamping = 0.08;  // the one of them that is tried outside the band too
constexpr double kOutsideMargin = 2;      // how far outside, as a factor of frequency
constexpr double kPoleReach = 60;      // half widths around a pole whose lines say whether it is worth trying
constexpr double kSpacingShare = 0.5;  // of the line spacing: poles are tried no closer together

// The residual of a curve times its weight, whole lanes long.
struct WeightedResidual {
  Eigen::ArrayXd weight, re, im;
};

struct WeightedResiduals {
  Eigen::ArrayXd omega;  // filled up with the last line, which has no weight there
  std::vector<WeightedResidual> curves;
};

WeightedResiduals weighted_residuals(const FitData& data, const std::vector<dynamics::Mode>& modes) {
  const Eigen::Index lines = (data.lines() + numerics::kLanes - 1) / numerics::kLanes * numerics::kLanes;
  WeightedResiduals result;
  result.omega = Eigen::ArrayXd::Constant(lines, data.highest());
  result.omega.head(data.lines()) = data.s.imag();
  const std::vector<ErrorWeights> weights = error_weights(data);
  std::vector<Eigen::VectorXcd> left;
  for (const Curve& curve : data.curves) left.push_back(curve.h - curve_of(modes, curve, data.s));
  left = weighted_errors(data, weights, std::move(left));
  for (std::size_t c = 0; c < left.size(); ++c) {
    WeightedResidual weighted;
    weighted.weight = weighted.re = weighted.im = Eigen::ArrayXd::Zero(lines);
    weighted.weight.head(data.lines()) = weights[c].diagonal();
    weighted.re.head(data.lines()) = left[c].real();
    weighted.im.head(data.lines()) = left[c].imag();
    result.curves.push_back(std::move(weighted));
  }
  return result;
}

// Weighted sums over some lines for the best residue of a pole -alpha + i beta. The curve of a residue a + i
// b is a times `own`, the sum of the pole and its mirror image, plus b times `other`, i times their
// difference.
struct PairSums {
  double own_own, own_other, other_other, own_residual, other_residual;
};

STABLECUT_WIDE PairSums pair_sums(const double* omega, const double* weight, const double* re,
                                  const double* im, Eigen::Index lines, double alpha, double beta) {
  numerics::Lanes aa{}, ab{}, bb{}, ar{}, br{};
  for (Eigen::Index i = 0; i < lines; i += numerics::kLanes) {
    const numerics::Lanes line = numerics::load_lanes(omega + i), below = line - beta, above = line + beta;
    const numerics::Lanes size = 1 / (alpha * alpha + below * below),
                          mirrored = 1 / (alpha * alpha + above * above);
    const numerics::Lanes a_re = alpha * (size + mirrored), a_im = -(below * size + above * mirrored);
    const numerics::Lanes b_re = below * size - above * mirrored, b_im = alpha * (size - mirrored);
    const numerics::Lanes w = numerics::load_lanes(weight + i), x = numerics::load_lanes(re + i),
                          y = numerics::load_lanes(im + i);
    aa += w * (a_re * a_re + a_im * a_im);
    ab += w * (a_re * b_re + a_im * b_im);
    bb += w * (b_re * b_re + b_im * b_im);
    ar += a_re * x + a_im * y;
    br += b_re * x + b_im * y;
  }
  return {numerics::sum_of(aa), numerics::sum_of(ab), numerics::sum_of(bb), numerics::sum_of(ar),
          numerics::sum_of(br)};
}

// What a pole with the residues of least squares, one a curve, takes away of the weighted residual.
struct Addition {
  double gain = 0;
  Eigen::RowVectorXcd residue;  // [curves]
};

std::optional<Addition> addition_at(const WeightedResiduals& residual, Complex pole) {
  // The lines that the pole reaches, as whole lanes.
  const double reach = -kPoleReach * pole.real();
  const Eigen::ArrayXd& omega = residual.omega;
  const Eigen::Index first =
      (std::lower_bound(omega.begin(), omega.end(), pole.imag() - reach) - omega.begin()) / numerics::kLanes *
      numerics::kLanes;
  const Eigen::Index last = std::upper_bound(omega.begin(), omega.end(), pole.imag() + reach) - omega.begin();
  const Eigen::Index count = (last - first + numerics::kLanes - 1) / numerics::kLanes * numerics::kLanes;
  if (count <= 0) return std::nullopt;
  Addition addition{0, Eigen::RowVectorXcd(residual.curves.size())};
  for (std::size_t e = 0; e < residual.curves.size(); ++e) {
    const WeightedResidual& curve = residual.curves[e];
    const PairSums sums = pair_sums(&omega[first], &curve.weight[first], &curve.re[first], &curve.im[first],
                                    count, -pole.real(), pole.imag());
    const Eigen::Matrix2d gram =
        (Eigen::Matrix2d() << sums.own_own, sums.own_other, sums.own_other, sums.other_other).finished();
    const Eigen::Vector2d projection(sums.own_residual, sums.other_residual);
    const Eigen::Vector2d parts = gram.inverse() * projection;
    addition.residue[e] = {parts[0], parts[1]};
    if (parts.allFinite()) addition.gain += parts.dot(projection);
  }
  return addition;
}

}  // namespace

dynamics::Mode rank_one_mode(const FitData& data, Complex pole, const Eigen::RowVectorXcd& residue) {
  dynamics::Mode mode;
  dynamics::set_pole(mode, pole);
  mode.psi_r = mode.psi_l = Eigen::VectorXcd::Zero(data.dofs);
  // Curves that share no component of either vector (xy and yx alone) are each of rank one by themselves.
  const std::vector<std::size_t> part = data.vector_parts();
  for (std::size_t p = 0; std::find(part.begin(), part.end(), p) != part.end(); ++p) {
    Eigen::MatrixXcd matrix = Eigen::MatrixXcd::Zero(data.dofs, data.dofs);
    for (std::size_t e = 0; e < data.curves.size(); ++e) {
      if (part[e] == p) matrix(data.curves[e].response, data.curves[e].reference) = residue[e];
    }
    const Eigen::JacobiSVD<Eigen::MatrixXcd> svd(matrix, Eigen::ComputeThinU | Eigen::ComputeThinV);
    mode.psi_r += svd.matrixU().col(0);
    mode.psi_l += svd.singularValues()[0] * svd.matrixV().col(0).conjugate();
  }
  return mode;
}

dynamics::Mode best_addition(const FitData& data, const std::vector<dynamics::Mode>& modes) {
  const WeightedResiduals residual = weighted_residuals(data, modes);
  const double spacing = data.line_spacing();
  double best_gain = -1;
  dynamics::Mode best;
  for (const double zeta : kDampings) {
    const double margin = zeta == kOutsideDamping && !data.residual_terms ? kOutsideMargin : 1;
    for (double rate = std::max(data.lowest(), spacing) / margin; rate <= data.highest() * margin;
         rate += std::max(zeta * rate, kSpacingShare * spacing)) {
      const Complex pole = rate * Complex(-zeta, std::sqrt(1 - zeta * zeta));
      if (data.is_residual(pole)) continue;
      const std::optional<Addition> addition = addition_at(residual, pole);
      if (!addition || !(addition->gain > best_gain) || !addition->residue.allFinite()) continue;
      best_gain = addition->gain;
      best = rank_one_mode(data, pole, addition->residue);
    }
  }
  return best;
}

}  // namespace stablecut::modal
