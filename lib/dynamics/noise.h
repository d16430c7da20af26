// Noise of a measured curve, from itself: what no smooth curve follows.
#pragma once

#include <Eigen/Core>

namespace stablecut {

/// Estimated variance of the complex values on each line: fourth differences (blind to a cubic) squared,
/// their median over a window of lines, so that a narrow peak does not count as noise. The noise may follow
/// the signal's `size` (its modulus on each line) more closely than a window can: the median is also taken of
/// the noise over the size, and the likelier of the two is kept. Equal or nearly equal spacing is assumed.
/// [lines]; zero for a curve without noise.
Eigen::VectorXd estimated_variance(const Eigen::VectorXcd& values, const Eigen::VectorXd& size);

/// Variance on each line of a white residual, from all of it.
struct ResidualNoise {
  Eigen::VectorXd smooth;  ///< [lines] a floor plus a share of the signal's size squared, the likeliest
  Eigen::VectorXd local;   ///< [lines] running mean
  bool is_local = false;   ///< the running mean is clearly likelier, for all its parameters
};
ResidualNoise residual_noise(const Eigen::VectorXcd& residual, const Eigen::VectorXd& size);

/// Correlation length of residuals in lines: 1 for white noise, more for a misfit that is smooth over lines.
double correlation_length(const Eigen::VectorXcd& residual);

}  // namespace stablecut
