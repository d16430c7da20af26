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

/// Variance on each line of a white residual, from all of it: a floor plus a share of the signal's `size`
/// squared, fitted by maximum likelihood, or where that is clearly less likely than what is seen locally, a
/// running mean. [lines]
Eigen::VectorXd residual_variance(const Eigen::VectorXcd& residual, const Eigen::VectorXd& size);

/// Correlation length of residuals in lines: 1 for white noise, more for a misfit that is smooth over lines.
double correlation_length(const Eigen::VectorXcd& residual);

}  // namespace stablecut
