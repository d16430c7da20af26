// Modes to try: of rank one at a given pole, and where one would explain most of what is left (README.md,
// "Candidates").
#pragma once

#include <Eigen/Core>
#include <complex>
#include <vector>

#include "dynamics/modal_model.h"
#include "modal/fit_data.h"

namespace stablecut::modal {

/// The mode at a pole (rad/s) whose residue psi_r psi_l^T is nearest, in the Frobenius norm, to these
/// residues of the curves [curves] [Eckart1936]; a pair of directions without a curve counts as zero.
dynamics::Mode rank_one_mode(const FitData& data, std::complex<double> pole,
                             const Eigen::RowVectorXcd& residue);

/// The mode that by itself takes away most of the weighted residual of `modes`: its pole is one of a grid
/// over frequency and damping that reaches a little outside the band, its residue that of least squares, made
/// rank one.
dynamics::Mode best_addition(const FitData& data, const std::vector<dynamics::Mode>& modes);

}  // namespace stablecut::modal
