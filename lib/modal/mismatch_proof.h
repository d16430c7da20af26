// Entries that do not fit together, proved by modes: README.md, "Entries that do not fit together".
#pragma once

#include <vector>

#include "modal/entry_matching.h"
#include "modal/group_fit.h"
#include "modal/mode_selection.h"

namespace stablecut::modal {

/// What is wrong with curves of a finished fit: of the mismatches that their residues suggest those without
/// which fewer modes, or less of a residual, explain the curves. `given` is the variance of the noise, empty
/// where it was estimated; `is_driving_point` [curves].
std::vector<EntryMismatch> proved_mismatches(const GroupFit& fit, const CurveVariances& given,
                                             const std::vector<bool>& is_driving_point,
                                             const SelectionOptions& options);

}  // namespace stablecut::modal
