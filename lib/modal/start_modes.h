// Modes to start a search from, without a guess: README.md, "Start".
#pragma once

#include "modal/group_fit.h"

namespace stablecut::modal {

/// Poles of the weighted curves by vector fitting, those that matter (rad/s); where there are residual terms,
/// those in the band and theirs.
Eigen::VectorXcd find_poles(const GroupFit& fit);

/// The poles in the band, and those of the residual terms.
Eigen::VectorXcd with_residual_terms(const FitData& data, const Eigen::VectorXcd& poles);

/// Modes at the poles, each with the nearest residue of rank one.
std::vector<dynamics::Mode> modes_at(const FitData& data, const Eigen::VectorXcd& poles);

/// Modes at such poles with the nearest residues of rank one, refined; the rigid body of a suspended
/// structure as one mode for each direction.
RefinedModes start_modes(const GroupFit& fit, const Eigen::VectorXcd& poles);

}  // namespace stablecut::modal
