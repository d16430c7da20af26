#include "modal/group_fit.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "dynamics/noise.h"

namespace stablecut::modal {
namespace {

// Mean chi-square from which on it is not the noise that limits the fit.
constexpr double kModelErrorFactor = 1.5;
// Inflation from which on a residual is not white, for many lines, and what fewer lines add to it.
constexpr double kLargestInflation = 1.6, kInflationOfFewLines = 30;
// Two poles nearer than this share of the smaller half width stand at one place.
constexpr double kOnePole = 0.5;
// 1 / sqrt 2: the receptance of a mode damped more has no maximum.
constexpr double kNoResonance = 0.7071067811865476;
constexpr double kMostLeft = 0.05;  // relative error that modes shall go below whatever the noise

}  // namespace

RefinedModes GroupFit::refine(const std::vector<dynamics::Mode>& modes, const Effort& effort) const {
  return refine_modes(data, modes, model, effort);
}

std::size_t GroupFit::own_modes() const {
  return static_cast<std::size_t>(std::count_if(
      modes().begin(), modes().end(), [&](const auto& mode) { return !data.is_residual(mode.pole()); }));
}

void GroupFit::weigh(Regime regime_now) {
  regime = regime_now;
  weigh_curves(data, variance, shared, regime);
}

double GroupFit::parameters_per_mode() const {
  std::vector<bool> right(data.dofs), left(right.size());
  for (const Curve& curve : data.curves) {
    right[curve.response] = true;
    left[curve.reference] = true;
  }
  const auto hidden =
      std::count(right.begin(), right.end(), false) + std::count(left.begin(), left.end(), false);
  const Eigen::Index all = ModeParameters::per_mode(model, data.dofs);
  // The symmetric models show by one vector what the other hides.
  return static_cast<double>(model == ModeModel::kNonsymmetric ? all - 2 * hidden : all);
}

double GroupFit::degrees_of_freedom() const {
  const double parameters = parameters_per_mode() * static_cast<double>(modes().size());
  return std::max(complex_values() - parameters / 2, 1.0);
}

double GroupFit::inflation() const {
  return regime == Regime::kModelError ? inflation_of(refined) : std::max(1.0, reduced_chi_square());
}

double GroupFit::inflation_of(const RefinedModes& others) const {
  double length = 0, curves = 0;
  for (const Curve& curve : data.curves) {
    if (curve.h.isZero(0)) continue;
    const Eigen::VectorXcd residual = curve_of(others.modes, curve, data.s) - curve.h;
    length += dynamics::correlation_length(curve.weight.cwiseSqrt().cwiseProduct(residual));
    ++curves;
  }
  return std::max(1.0, others.chi_square / complex_values()) * length / curves;
}

double GroupFit::expected_error() const {
  double sum = 0, curves = 0;
  for (std::size_t c = 0; c < data.curves.size(); ++c) {
    if (data.curves[c].h.isZero(0)) continue;
    sum += variance[c].sum() / data.curves[c].h.squaredNorm();
    ++curves;
  }
  return std::min(kMostLeft, std::sqrt(kModelErrorFloor * kModelErrorFloor + sum / curves));
}

bool GroupFit::exceeds_noise(double chi_square) const {
  return chi_square / complex_values() > kModelErrorFactor;
}

bool GroupFit::residual_is_white() const {
  return inflation_of(refined) < kLargestInflation + kInflationOfFewLines / static_cast<double>(data.lines());
}

bool GroupFit::is_crowded() const {
  return std::any_of(modes().begin(), modes().end(), [&](const dynamics::Mode& mode) {
    const std::complex<double> pole = mode.pole();
    const auto near = std::count_if(modes().begin(), modes().end(), [&](const dynamics::Mode& other) {
      return std::abs(other.pole() - pole) < kOnePole * std::min(-other.pole().real(), -pole.real());
    });
    return near > data.dofs;
  });
}

bool GroupFit::has_helpers() const {
  return std::any_of(modes().begin(), modes().end(), [&](const dynamics::Mode& mode) {
    return mode.damping_ratio > kNoResonance && data.in_band(mode.pole());
  });
}

double relative_error(const FitData& data, const std::vector<dynamics::Mode>& modes) {
  double sum = 0, curves = 0;
  for (const Curve& curve : data.curves) {
    if (curve.h.isZero(0)) continue;
    sum += (curve_of(modes, curve, data.s) - curve.h).squaredNorm() / curve.h.squaredNorm();
    ++curves;
  }
  return std::sqrt(sum / curves);
}

double reduced_chi_square_of(const std::vector<GroupFit>& fits) {
  double chi_square = 0, freedom = 0;
  for (const GroupFit& fit : fits) {
    chi_square += fit.refined.chi_square;
    freedom += fit.degrees_of_freedom();
  }
  return chi_square / freedom;
}

}  // namespace stablecut::modal
