// How large the noise of a measured curve is, estimated from the curve itself or from what a model leaves of
// it. The estimators and their error: README.md, "Noise".
#pragma once

#include <Eigen/Core>
#include <vector>

namespace stablecut::dynamics {

/// Ways in which the noise may depend on the line: standard deviations up to a common factor, each [lines].
using NoiseShapes = std::vector<Eigen::VectorXd>;

/// Noise that is the same on every line as displacement, as velocity or as acceleration: as a receptance it
/// falls like 1, 1 / omega or 1 / omega^2. `omega` [lines], above 0, in any unit.
NoiseShapes floor_shapes(const Eigen::VectorXd& omega);

/// Estimated variance E|error|^2 of the complex values on each line [lines], in the values' unit squared,
/// from fourth differences of the curve [Gasser1986], which a cubic does not reach. `lines` says where the
/// values stand (increasing, any unit, any spacing); `size` [lines] is the modulus of the signal, to which
/// noise may be proportional; `floors` are the other shapes that are tried. The likeliest shape holds for all
/// lines, or, where it `may_change`, until another one is clearly likelier. Zero for a curve without noise,
/// and for fewer than six lines.
Eigen::VectorXd estimated_variance(const Eigen::VectorXd& lines, const Eigen::VectorXcd& values,
                                   const Eigen::VectorXd& size, const NoiseShapes& floors,
                                   bool may_change = false);

/// Two estimates of the variance on each line of a residual that is white noise.
struct ResidualNoise {
  Eigen::VectorXd smooth;  ///< [lines] a floor of the likeliest shape plus a share of the size squared
  Eigen::VectorXd local;   ///< [lines] running mean
  bool is_local = false;   ///< Schwarz' criterion prefers the running mean, for all its parameters
};
/// `residual`, `size` and each of `floors` [lines], as for estimated_variance.
ResidualNoise residual_noise(const Eigen::VectorXcd& residual, const Eigen::VectorXd& size,
                             const NoiseShapes& floors);

/// A variance on each line [lines] from estimates that each rest on `freedom` independent complex values, as
/// one from a coherence of freedom + 1 averages does: where these are few, each line is pooled with its
/// neighbours, as multiples of the likeliest smooth shape. The inverse of a single estimate would be far too
/// large a weight on average. `size` and each of `floors` [lines], as for estimated_variance.
Eigen::VectorXd pooled_variance(const Eigen::VectorXd& estimates, double freedom, const Eigen::VectorXd& size,
                                const NoiseShapes& floors);

/// Correlation length of a residual in lines [Bayley1946]: how many neighbouring values tell as much as one
/// independent value. 1 for white noise and for a residual of zeros, more for a misfit that is smooth over
/// lines.
double correlation_length(const Eigen::VectorXcd& residual);

}  // namespace stablecut::dynamics
