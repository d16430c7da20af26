#include "modal/noise_weights.h"

#include <algorithm>
#include <cmath>

#include "dynamics/noise.h"
#include "modal/maximum_likelihood.h"

namespace stablecut::modal {
namespace {

// No weight claims less noise than these shares of the value, and than kRmsShare of that of the curve's RMS.
constexpr double kCoarseFloor = 1e-4;
constexpr double kFineFloor = 1e-7;
constexpr double kRmsShare = 0.01;
constexpr double kNearby = 2;            // factor of frequency within which a levelled curve has its size
constexpr double kDecidingShare = 0.01;  // of all weights, above which the floors are said to decide
constexpr double kClearOfNoise = 10;     // |H|^2 over the noise's variance
constexpr double kLeast = 1e-300;        // of |h|^2, in a quotient
constexpr double kOtherNoise = 4;        // factor between two variances from which on modes are weighed again

double floor_share(Regime regime) { return regime == Regime::kNoiseless ? kFineFloor : kCoarseFloor; }

// Of the lines that are 10 dB clear of the noise, where there are any: at the first lines of an integrated
// acceleration noise can be ten thousand times what a structure does.
double rms(const Curve& curve, const Eigen::VectorXd& variance) {
  const Eigen::ArrayXd square = curve.h.array().abs2();
  const Eigen::ArrayXd clear = (square > kClearOfNoise * variance.array()).cast<double>();
  const double lines = clear.sum();
  return std::sqrt(lines > 0 ? (square * clear).sum() / lines : square.mean());
}

}  // namespace

void weigh_curves(FitData& data, const CurveVariances& variance, const CurveVariances& shared,
                  Regime regime) {
  double largest_rms = 0;
  for (std::size_t e = 0; e < data.curves.size(); ++e)
    largest_rms = std::max(largest_rms, rms(data.curves[e], variance[e]));
  const double of_value = floor_share(regime);
  const double of_rms = regime == Regime::kModelError ? kModelErrorFloor : kRmsShare * of_value;
  for (std::size_t e = 0; e < data.curves.size(); ++e) {
    Curve& curve = data.curves[e];
    // A curve of exact zeros is as sure as the largest one.
    const double own_rms = rms(curve, variance[e]);
    Eigen::ArrayXd size = Eigen::ArrayXd::Constant(curve.h.size(), own_rms > 0 ? own_rms : largest_rms);
    if (data.levelled && regime == Regime::kModelError && own_rms > 0) size = local_rms(data, curve, kNearby);
    curve.weight =
        (variance[e].array() + of_value * of_value * curve.h.array().abs2() + (of_rms * size).square())
            .inverse();
    curve.shared.resize(0);
    if (regime == Regime::kModelError || shared.empty() || shared[e].size() == 0) continue;
    // The floors are the curve's own. Of the measured values only the phase, which all curves turn alike:
    // with their size, which is noisy too, less than nothing could be left of the own part.
    curve.shared = curve.h.array() * (shared[e].array() / curve.h.array().abs2().max(kLeast)).sqrt();
  }
}

bool floors_decide(const FitData& data, Regime regime) {
  const double floor = floor_share(regime);
  double share = 0;
  for (const Curve& curve : data.curves) share += floor * floor * curve.h.cwiseAbs2().dot(curve.weight);
  return share > kDecidingShare * (data.values() / 2);
}

CurveVariances scatter_of_curves(const FitData& data) {
  const dynamics::NoiseShapes floors = dynamics::floor_shapes(data.s.imag());
  CurveVariances variance;
  for (const Curve& curve : data.curves)
    variance.push_back(dynamics::estimated_variance(data.s.imag(), curve.h, curve.h.cwiseAbs(), floors));
  return variance;
}

CurveVariances scatter_of_residual(const FitData& data, const std::vector<dynamics::Mode>& modes) {
  const dynamics::NoiseShapes floors = dynamics::floor_shapes(data.s.imag());
  CurveVariances variance;
  for (const Curve& curve : data.curves) {
    const Eigen::VectorXcd model = curve_of(modes, curve, data.s);
    variance.push_back(
        dynamics::estimated_variance(data.s.imag(), model - curve.h, model.cwiseAbs(), floors));
  }
  return variance;
}

ResidualVariances residual_as_noise(const FitData& data, const std::vector<dynamics::Mode>& modes,
                                    double correction, bool local_allowed) {
  const dynamics::NoiseShapes floors = dynamics::floor_shapes(data.s.imag());
  ResidualVariances result;
  for (const Curve& curve : data.curves) {
    const Eigen::VectorXcd model = curve_of(modes, curve, data.s);
    const dynamics::ResidualNoise noise = dynamics::residual_noise(model - curve.h, model.cwiseAbs(), floors);
    result.variance.push_back(correction * (local_allowed && noise.is_local ? noise.local : noise.smooth));
    result.is_local = result.is_local || noise.is_local;
  }
  return result;
}

bool differ_much(const CurveVariances& a, const CurveVariances& b) {
  for (std::size_t e = 0; e < a.size(); ++e) {
    if ((a[e].array() > kOtherNoise * b[e].array()).any() ||
        (b[e].array() > kOtherNoise * a[e].array()).any())
      return true;
  }
  return false;
}

}  // namespace stablecut::modal
