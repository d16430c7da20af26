// Modes that decide the limits although the measurement hardly knows them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dynamics/modal_model.h"
#include "milling/lobes.h"
#include "options.h"

namespace stablecut {

/// What should be said of modes that limit the depth at some speed of a chart of `tables`: outside of the
/// measured band, next to no damping, or numbers less sure than the damping. One line for each.
std::vector<std::string> doubtful_critical_modes(const milling::StabilityChart& chart,
                                                 const std::vector<dynamics::ModalModel>& tables);

/// What those of the modes (indices in the table) that none of this can be said of would limit the depth to
/// by themselves, and the option for it: a line. Nothing where they have no answer.
std::optional<std::string> limit_without_doubtful(const dynamics::ModalModel& table,
                                                  const std::vector<std::size_t>& modes,
                                                  const document::Source& source,
                                                  const milling::Cutter& cutter, const ChartAxes& axes,
                                                  const milling::StabilityScheme& scheme, int threads);

}  // namespace stablecut
