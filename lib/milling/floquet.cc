#include "milling/floquet.h"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>

#include "base/units.h"

namespace stablecut {
namespace {

using Complex = std::complex<double>;

// A real multiplier's imaginary part is zero but for rounding.
constexpr double kRealMultiplier = 1e-7;

}  // namespace

double spectral_radius(const PeriodMap& map, double depth_m) {
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(map.monodromy(depth_m), false);
  if (solver.info() != Eigen::Success) return std::numeric_limits<double>::quiet_NaN();
  return solver.eigenvalues().cwiseAbs().maxCoeff();
}

CriticalMultiplier critical_multiplier(const PeriodMap& map, double depth_m) {
  const TipStructure& structure = map.structure();
  const Eigen::Index d = structure.directions();
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(map.monodromy(depth_m), true);
  Eigen::Index largest = 0;
  solver.eigenvalues().cwiseAbs().maxCoeff(&largest);

  CriticalMultiplier critical;
  const Complex mu = critical.value = solver.eigenvalues()[largest];
  if (std::abs(mu.imag()) <= kRealMultiplier * std::abs(mu)) {
    critical.kind = mu.real() < 0 ? Instability::kFlip : Instability::kFold;
  }

  // Over the period that follows, r = mu r_delayed: f = depth * coefficient * (mu - 1) r_delayed.
  const Eigen::VectorXcd state = solver.eigenvectors().col(largest);
  std::vector<Eigen::VectorXcd> force;
  for (std::size_t i = 0; i < map.samples().size(); ++i) {
    const auto delayed = state.segment(2 * structure.modes() + static_cast<Eigen::Index>(i) * d, d);
    force.push_back(map.samples()[i].weight_s * (map.samples()[i].coefficient * delayed));
  }
  const Complex exponent = std::log(mu) / map.period_s();
  const double highest = structure.lambda.cwiseAbs().maxCoeff();
  const auto harmonics = static_cast<int>(std::ceil(1.2 * highest * map.period_s() / kTwoPi)) + 1;
  double best = -1;
  for (int k = -harmonics; k <= harmonics; ++k) {
    const Complex s = exponent + Complex(0, kTwoPi * k / map.period_s());
    Eigen::VectorXcd amplitude = Eigen::VectorXcd::Zero(d);
    for (std::size_t i = 0; i < force.size(); ++i) amplitude += force[i] * std::exp(-s * map.samples()[i].time_s);
    amplitude = structure.receptance(s) * amplitude;
    // A tie (k and its mirror image of a real multiplier) goes to the first: the frequency is the same.
    if (amplitude.norm() > best * (1 + 1e-9)) {
      best = amplitude.norm();
      critical.chatter_frequency_hz = hz_from_rad_per_s(std::abs(s.imag()));
    }
  }
  return critical;
}

}  // namespace stablecut
