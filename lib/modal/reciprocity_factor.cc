#include "modal/reciprocity_factor.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <complex>
#include <optional>
#include <utility>
#include <vector>

namespace stablecut::modal {
namespace {

using Complex = std::complex<double>;

constexpr double kClearLogarithm = 0.1;  // standard deviation up to which the logarithm of a ratio is linear
constexpr std::size_t kLeastModes = 3;   // that a scatter is told from
constexpr double kSureFactor = 7;        // logarithm of the odds against chance
constexpr double kLeastFactor = 0.02;    // logarithm
constexpr int kHalvings = 60;            // of the interval of a scatter

// Logarithms of R_ij / R_ji, and their covariance.
struct Ratios {
  Eigen::VectorXd value;
  Eigen::MatrixXd covariance;
};

Ratios ratios_of(const dynamics::ModalModel& table, Eigen::Index i, Eigen::Index j) {
  const Eigen::Index each = table.parameters_per_mode(), dofs = static_cast<Eigen::Index>(table.dofs.size());
  std::vector<double> values;
  std::vector<Eigen::VectorXd> slopes;
  for (std::size_t k = 0; k < table.modes.size(); ++k) {
    const dynamics::Mode& mode = table.modes[k];
    const Complex above = mode.psi_r[i] * mode.psi_l[j], below = mode.psi_r[j] * mode.psi_l[i];
    if (mode.out_of_band || above == 0.0 || below == 0.0) continue;
    Eigen::VectorXd slope = Eigen::VectorXd::Zero(table.covariance.rows());
    // The real part of a logarithm moves by Re(dz / z).
    const auto add = [&](Eigen::Index at, Complex z, double sign) {
      const Eigen::Index place = static_cast<Eigen::Index>(k) * each + at;
      slope[place] = sign * (1.0 / z).real();
      slope[place + 1] = -sign * (1.0 / z).imag();
    };
    const Eigen::Index left = 2 + 2 * dofs;
    add(2 + 2 * i, mode.psi_r[i], 1);
    add(2 + 2 * j, mode.psi_r[j], -1);
    add(left + 2 * j, mode.psi_l[j], 1);
    add(left + 2 * i, mode.psi_l[i], -1);
    if (!(slope.dot(table.covariance * slope) < kClearLogarithm * kClearLogarithm)) continue;
    values.push_back(std::log(std::abs(above / below)));
    slopes.push_back(std::move(slope));
  }
  Ratios ratios{Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size())),
                {}};
  Eigen::MatrixXd slope(table.covariance.rows(), ratios.value.size());
  for (Eigen::Index k = 0; k < slope.cols(); ++k) slope.col(k) = slopes[static_cast<std::size_t>(k)];
  ratios.covariance = slope.transpose() * table.covariance * slope;
  return ratios;
}

// Mean of correlated values with a further scatter, its variance, and what is left in units of the
// deviations.
struct Mean {
  double value = 0, variance = 0, left = 0;
};

Mean mean_of(const Ratios& ratios, double scatter) {
  const Eigen::Index n = ratios.value.size();
  const Eigen::LLT<Eigen::MatrixXd> factor(ratios.covariance +
                                           scatter * scatter * Eigen::MatrixXd::Identity(n, n));
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(n), along = factor.solve(ones);
  Mean mean;
  mean.variance = 1 / along.sum();
  mean.value = along.dot(ratios.value) * mean.variance;
  const Eigen::VectorXd away = ratios.value - mean.value * ones;
  mean.left = away.dot(factor.solve(away));
  return mean;
}

std::optional<ReciprocityFactor> factor_of(const dynamics::ModalModel& table, Eigen::Index i,
                                           Eigen::Index j) {
  const Ratios ratios = ratios_of(table, i, j);
  const auto modes = static_cast<std::size_t>(ratios.value.size());
  if (modes < kLeastModes) return std::nullopt;
  // The scatter over the modes, beyond their deviations, with which what is left is what is expected.
  const double freedom = static_cast<double>(modes) - 1;
  double low = 0, high = (ratios.value.array() - ratios.value.mean()).abs().sum();
  if (mean_of(ratios, 0).left <= freedom) high = 0;
  for (int step = 0; step < kHalvings && high > 0; ++step) {
    const double middle = (low + high) / 2;
    (mean_of(ratios, middle).left > freedom ? low : high) = middle;
  }
  const Mean mean = mean_of(ratios, high);
  // Student's distribution, as the scatter is known from these modes alone.
  const double odds = (freedom + 1) / 2 * std::log1p(mean.value * mean.value / mean.variance / freedom);
  if (std::abs(mean.value) < kLeastFactor || odds < kSureFactor) return std::nullopt;
  const double factor = std::exp(mean.value);
  return ReciprocityFactor{i, j, factor, factor * std::sqrt(mean.variance), modes};
}

}  // namespace

std::vector<ReciprocityFactor> reciprocity_factors(const dynamics::ModalModel& table) {
  std::vector<ReciprocityFactor> factors;
  const auto dofs = static_cast<Eigen::Index>(table.dofs.size());
  for (Eigen::Index i = 0; i < dofs; ++i)
    for (Eigen::Index j = i + 1; j < dofs; ++j)
      if (const auto factor = factor_of(table, i, j)) factors.push_back(*factor);
  return factors;
}

}  // namespace stablecut::modal
