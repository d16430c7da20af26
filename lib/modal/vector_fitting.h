// Poles from data without a guess: relaxed vector fitting [Gustavsen1999] [Gustavsen2006] of the weighted
// curves, and linear least squares for the residues of given poles. README.md, "Vector fitting".
#pragma once

#include <Eigen/Core>
#include <vector>

#include "modal/fit_data.h"

namespace stablecut::modal {

/// Lines for each pole pair at least: least squares cannot tell more pairs apart.
inline constexpr Eigen::Index kLinesPerPair = 3;

/// Poles to start from (rad/s, with positive imaginary parts): a third of `pairs` evenly over the band by
/// logarithm, a third evenly, a third where the curves turn most, and one more on either side of the band.
/// `pairs` at least 3.
Eigen::VectorXcd starting_poles(const FitData& data, Eigen::Index pairs);

/// One relocation: the poles of the data's common denominator, if the given poles are near them. Unstable
/// ones are mirrored into the left half plane; two real ones become a heavily damped pair. Sorted by |pole|.
Eigen::VectorXcd relocate_poles(const FitData& data, const Eigen::VectorXcd& poles);

/// Residues for given poles by weighted linear least squares, of any rank, curve by curve.
struct LinearResidues {
  Eigen::MatrixXcd residue;  ///< [poles x curves]
  double chi_square = 0;     ///< sum of |model - h|^2 / variance
  Eigen::MatrixXd loss;      ///< [poles x curves] in chi-square of a curve when it has no residue at the pole
  /// Loss in chi-square when a pole is left out and the other residues adapt: [poles].
  Eigen::VectorXd removal_loss;
};
LinearResidues linear_residues(const FitData& data, const Eigen::VectorXcd& poles);

}  // namespace stablecut::modal
