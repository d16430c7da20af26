// Noise of a measured curve, from itself: what no smooth curve follows.
#pragma once

#include <Eigen/Core>

namespace stablecut {

/// Estimated variance of the complex values on each line: fourth differences (blind to a cubic) squared, their median
/// over a window of lines, so that a narrow peak does not count as noise. Equal or nearly equal spacing is assumed.
/// With fewer than 12 lines the whole curve is one window. [lines]; zero for a curve without noise.
Eigen::VectorXd estimated_variance(const Eigen::VectorXcd& values);

/// Correlation length of residuals in lines: 1 for white noise, more for a misfit that is smooth over lines.
double correlation_length(const Eigen::VectorXcd& residual);

}  // namespace stablecut
