// Natural frequencies that differ between the curves of one force, or of one response, and the others:
// README.md, "Poles that are shifted".
#pragma once

#include <Eigen/Core>
#include <optional>

#include "modal/group_fit.h"

namespace stablecut::modal {

/// The curves of one direction's force, or response, have poles that are a factor times those of the others.
struct PoleShift {
  Eigen::Index direction = 0;
  bool of_force = true;  ///< curves are told apart by their reference; else by their response
  /// Of the natural frequencies: the least and the most, equal where one factor explains all modes; and the
  /// standard deviation (the largest).
  double least = 1, most = 1, deviation = 0;
  std::size_t doubled = 0;  ///< modes that the fit has twice to make up for it
  bool in_all = true;       ///< all modes have it; else the doubled ones
};

/// Whether a shift explains what pairs of close modes do in a finished fit, or explains the curves better
/// than its modes: the likeliest one. Only of square matrices of curves in the non-symmetric model.
std::optional<PoleShift> pole_shift(const GroupFit& fit);

}  // namespace stablecut::modal
