// The search for the modes of one independent group of directions: README.md, "Search".
#pragma once

#include "modal/group_fit.h"
#include "modal/mode_selection.h"

namespace stablecut::modal {

/// Finds the modes behind the curves. `variance` is that of the noise where it is known, and empty where it
/// is to be estimated from the curves and from what the modes leave. The weights of `data` are set here.
/// Where poles are given the modes are those, refined (vectors alone where data.poles_fixed), and only the
/// noise is looked for.
GroupFit search_modes(FitData data, CurveVariances variance, const SelectionOptions& options);

/// The modes of a finished search in another model, selected again at that model's price, with the same
/// weights.
GroupFit in_model(GroupFit fit, ModeModel model, const SelectionOptions& options);

}  // namespace stablecut::modal
