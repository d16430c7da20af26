// Lagrange's interpolation between the lines of a curve, and where it cannot be relied upon. README.md,
// "Interpolation".
#pragma once

#include <Eigen/Core>
#include <map>
#include <vector>

namespace stablecut::dynamics {

/// What an interpolated value takes of the values at some lines, by their indices.
using LineWeights = std::map<Eigen::Index, double>;

/// The weights of the cubic through the four lines nearest to `at`, which lies between the lines `above` - 1
/// and `above` of `frequency_hz` (increasing); of fewer where there are fewer.
LineWeights cubic_weights(const Eigen::VectorXd& frequency_hz, Eigen::Index above, double at);

/// Neighbouring lines between which a curve turns more than its lines tell.
struct DoubtfulInterval {
  double from_hz, to_hz;
  double error;  ///< estimated largest error of the cubic, a share of the largest |h| at the lines around
};

/// The intervals in which the cubic may be off by more than kDoubtfulShare on one of `wanted_hz`, increasing
/// and within the band of `frequency_hz`; intervals that touch are one. `h` and `variance` (of the complex
/// value) [lines] stand at `frequency_hz`, increasing. README.md says what is compared.
std::vector<DoubtfulInterval> doubtful_intervals(const Eigen::VectorXd& frequency_hz,
                                                 const Eigen::VectorXcd& h, const Eigen::VectorXd& variance,
                                                 const Eigen::VectorXd& wanted_hz);

}  // namespace stablecut::dynamics
