// Where another mode would explain most of what is left.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <vector>

#include "dynamics/modal_model.h"
#include "modal/fit_data.h"

namespace stablecut::modal {

/// The mode whose residue psi_r psi_l^T is nearest to the curves' residues [curves]; a missing curve counts
/// as zero.
dynamics::Mode rank_one_mode(const FitData& data, std::complex<double> pole,
                             const Eigen::RowVectorXcd& residue);

/// The pole, of a grid over frequency and damping that reaches a little outside the band, that alone takes
/// away most of the weighted residual of `modes`, with the residue that does so.
dynamics::Mode best_addition(const FitData& data, const std::vector<dynamics::Mode>& modes);

}  // namespace stablecut::modal
