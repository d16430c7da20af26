// Modes that decide the limits although the measurement hardly knows them.
#pragma once

#include <string>
#include <vector>

#include "dynamics/modal_model.h"
#include "milling/lobes.h"

namespace stablecut {

/// What should be said of modes that limit the depth at some speed of a chart of `tables`: outside of the
/// measured band, next to no damping, or numbers less sure than the damping. One line for each.
std::vector<std::string> doubtful_critical_modes(const milling::StabilityChart& chart,
                                                 const std::vector<dynamics::ModalModel>& tables);

}  // namespace stablecut
