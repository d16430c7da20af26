// Poles from data without a guess: relaxed vector fitting (Gustavsen and Semlyen 1999, Gustavsen 2006), with
// the curves' weights, and linear least squares for the residues of given poles.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "modal/fit_data.h"

namespace stablecut::modal {

/// Start poles over the band of the data: a third spaced by logarithm, a third evenly, and a third where the
/// curves turn most, and one more on either side of the band. `pairs` at least 3. Positive imaginary parts,
/// rad/s.
Eigen::VectorXcd starting_poles(const FitData& data, Eigen::Index pairs);

/// One relocation: poles of the data's common denominator, given poles near them. Unstable ones are mirrored,
/// real ones become heavily damped. As many as given, sorted by frequency.
Eigen::VectorXcd relocate_poles(const FitData& data, const Eigen::VectorXcd& poles);

/// Full residue matrices for fixed poles by weighted linear least squares, curve by curve.
struct LinearResidues {
  Eigen::MatrixXcd residue;  ///< [poles x curves]
  double chi_square = 0;     ///< sum of |model - h|^2 / variance
  /// Loss in chi-square when a pole is left out and the other residues adapt: [poles].
  Eigen::VectorXd removal_loss;
};
LinearResidues linear_residues(const FitData& data, const Eigen::VectorXcd& poles);

}  // namespace stablecut::modal
