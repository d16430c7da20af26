// Which modes stay: README.md, "Selection".
#pragma once

#include <optional>

#include "base/progress.h"
#include "modal/group_fit.h"

namespace stablecut::modal {

/// Rounds of removing and adding after which a selection is ended although it has not settled.
inline constexpr int kSelectionRounds = 60;

struct SelectionOptions {
  std::optional<int> wanted_modes;  ///< keep that many, whatever they are worth
  Progress progress;
  int rounds = kSelectionRounds;
  /// Given poles, rad/s; then wanted_modes is their number, and none is looked for. Empty: none are given.
  Eigen::VectorXcd poles{};
  Eigen::VectorXcd starts{};  ///< poles to start the search from, rad/s; empty: found in the curves
};

/// How much chi-square a mode must take away to be worth its parameters, judged by what the residual `with`
/// the mode (or `without` it, where the model is the limit) tells.
double price_of_mode(const GroupFit& fit, const RefinedModes& with, const RefinedModes& without);

/// Removes modes that are not worth their price and adds those that are, until neither is left or the rounds
/// are over, which `fit.selection_settled` then says.
void select_modes(GroupFit& fit, const SelectionOptions& options);

/// The modes with one more where the residual asks most for one; nothing where that does not pay.
std::optional<RefinedModes> with_another_mode(const GroupFit& fit, std::optional<int> wanted_modes);

/// Whether a mode stands between two lines and is so narrow that it moves one of them alone: a disturbed
/// line, no mode.
bool is_too_narrow(const FitData& data, const dynamics::Mode& mode);

}  // namespace stablecut::modal
