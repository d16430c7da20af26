// Noise of a measured curve, from itself: what no smooth curve follows.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace stablecut::dynamics {

/// How the noise of a curve may depend on the line: standard deviations up to a factor, each [lines].
using NoiseShapes = std::vector<Eigen::VectorXd>;

/// The same on every line in some quantity: as displacement, velocity or acceleration it was measured, so
/// that as a receptance it falls like 1, 1 / omega or 1 / omega^2. `omega` [lines], above 0.
NoiseShapes floor_shapes(const Eigen::VectorXd& omega);

/// Estimated variance of the complex values on each line: fourth differences (blind to a cubic, whatever the
/// spacing of the lines, which stand at `lines`: increasing, in any unit) squared,
/// their median over a window of lines, so that a narrow peak does not count as noise. The noise may follow
/// a shape more closely than a window can: medians are taken of the noise over each of the floor shapes and
/// over the signal's `size` (its modulus on each line), and the likeliest is kept. [lines]; zero for a curve
/// without noise.
Eigen::VectorXd estimated_variance(const Eigen::VectorXd& lines, const Eigen::VectorXcd& values,
                                   const Eigen::VectorXd& size, const NoiseShapes& floors);

/// Variance on each line of a white residual, from all of it.
struct ResidualNoise {
  Eigen::VectorXd smooth;  ///< [lines] the likeliest of the floors plus a share of the size squared
  Eigen::VectorXd local;   ///< [lines] running mean
  bool is_local = false;   ///< the running mean is clearly likelier, for all its parameters
};
ResidualNoise residual_noise(const Eigen::VectorXcd& residual, const Eigen::VectorXd& size,
                             const NoiseShapes& floors);

/// Correlation length of residuals in lines: 1 for white noise, more for a misfit that is smooth over lines.
double correlation_length(const Eigen::VectorXcd& residual);

}  // namespace stablecut::dynamics
