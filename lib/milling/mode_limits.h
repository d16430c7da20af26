// The limit curve of each mode alone: which modes a chart's lobes belong to.
#pragma once

#include <cstddef>
#include <vector>

#include "base/progress.h"
#include "dynamics/modal_model.h"
#include "milling/cutter.h"
#include "milling/lobes.h"

namespace stablecut::milling {

struct ModeLimit {
  std::size_t mode = 0;                                   ///< index in the model
  std::vector<std::vector<StabilityCrossing>> crossings;  ///< [speeds], by depth
};

/// All crossings with each of the `modes` (indices in the model) as the structure's only one. A mode that no
/// force in x or y drives, or that moves neither, has none. Arguments and errors as stability_chart's.
std::vector<ModeLimit> limits_of_each_mode(const dynamics::ModalModel& model,
                                           const std::vector<std::size_t>& modes, const Cutter& cutter,
                                           const std::vector<double>& revolutions_per_s,
                                           const std::vector<double>& depths_m, const StabilityScheme& scheme,
                                           int threads, const Progress& progress = {});

}  // namespace stablecut::milling
