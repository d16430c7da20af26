#include "modal/maximum_likelihood.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>

#include "modal/likelihood.h"
#include "modal/pole_sums.h"
#include "modal/residual_sums.h"
#include "numerics/levenberg_marquardt.h"

namespace stablecut::modal {
namespace {

using Complex = std::complex<double>;

// Bounds of -Re lambda / Im lambda, and of Im lambda over the highest line. A mode far above the band looks
// nearly the same from three times the band on, and a high frequency costs time in a stability chart.
constexpr double kLeastRatio = 1e-6, kLargestRatio = 20;
constexpr double kLeastRate = 1e-5, kLargestRate = 3;
constexpr double kInside = 1e-9;  // of the band's ends: a mode that shall not leave the band stays off them

Eigen::VectorXd removal_loss(const ModeParameters& parameters, const Eigen::VectorXd& x,
                             const NormalEquations& normal) {
  const Eigen::MatrixXd covariance = inverse_normal_matrix(normal);
  Eigen::VectorXd loss(parameters.modes());
  for (Eigen::Index k = 0; k < loss.size(); ++k) {
    const Eigen::VectorXd change = parameters.removal(x, k);
    const Eigen::Index first = parameters.pole_at(k) + parameters.per_mode() - change.size();
    loss[k] = change.dot(
        Eigen::MatrixXd(covariance.block(first, first, change.size(), change.size())).llt().solve(change));
  }
  return loss;
}

}  // namespace

RefinedModes refine_modes(const FitData& data, const std::vector<dynamics::Mode>& start, ModeModel model,
                          const Effort& effort) {
  RefinedModes result;
  if (start.empty()) {
    result.chi_square = chi_square_of(data, start);
    result.converged = true;
    return result;
  }
  const ModeParameters parameters(start, data.dofs, model);
  const Likelihood likelihood(data, parameters, out_of_band(data, start));
  const double highest = data.s.cwiseAbs().maxCoeff(), unbounded = std::numeric_limits<double>::infinity();
  Eigen::VectorXd lower = Eigen::VectorXd::Constant(parameters.size(), -unbounded), upper = -lower;
  for (Eigen::Index k = 0; k < parameters.modes(); ++k) {
    if (data.holds(start[k].pole())) continue;
    const Eigen::Index at = parameters.pole_at(k);
    const double least = data.residual_terms ? (1 + kInside) * data.lowest() : kLeastRate * highest,
                 largest = data.residual_terms ? (1 - kInside) * data.highest() : kLargestRate * highest;
    lower.segment<2>(at) << std::log(kLeastRatio), std::log(least);
    upper.segment<2>(at) << std::log(kLargestRatio), std::log(largest);
  }
  const auto sums = [&](const Eigen::VectorXd& x, bool with_matrix) {
    return likelihood.evaluate(x, with_matrix);
  };
  const double complex_values = data.values() / 2;
  const numerics::LeastSquares least =
      numerics::levenberg_marquardt(sums, parameters.pack(start).cwiseMax(lower).cwiseMin(upper), lower,
                                    upper, {effort.iterations, effort.tolerance / complex_values});
  result.modes = parameters.unpack(least.x);
  for (std::size_t k = 0; k < start.size(); ++k) result.modes[k].out_of_band = start[k].out_of_band;
  result.converged = least.converged;
  result.chi_square = least.at.sum_of_squares;
  result.removal_loss = removal_loss(parameters, least.x, least.at);
  return result;
}

Eigen::VectorXcd curve_of(const std::vector<dynamics::Mode>& modes, const Curve& curve,
                          const Eigen::VectorXcd& s) {
  Eigen::VectorXcd h = Eigen::VectorXcd::Zero(s.size());
  for (const dynamics::Mode& mode : modes)
    add_pole_pair(s, mode.pole(), mode.psi_r[curve.response] * mode.psi_l[curve.reference], h);
  return h;
}

double chi_square_of(const FitData& data, const std::vector<dynamics::Mode>& modes) {
  Eigen::VectorXcd poles(modes.size());
  Eigen::MatrixXcd residue(modes.size(), data.curves.size());
  for (Eigen::Index k = 0; k < poles.size(); ++k) {
    const dynamics::Mode& mode = modes[k];
    poles[k] = mode.pole();
    for (Eigen::Index c = 0; c < residue.cols(); ++c)
      residue(k, c) = mode.psi_r[data.curves[c].response] * mode.psi_l[data.curves[c].reference];
  }
  return ResidualSums(data).evaluate(poles, residue, nullptr);
}

}  // namespace stablecut::modal
