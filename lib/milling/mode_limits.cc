#include "milling/mode_limits.h"

#include <utility>

#include "milling/structure.h"

namespace stablecut::milling {

std::vector<ModeLimit> limits_of_each_mode(const dynamics::ModalModel& model,
                                           const std::vector<std::size_t>& modes, const Cutter& cutter,
                                           const std::vector<double>& revolutions_per_s,
                                           const std::vector<double>& depths_m, const StabilityScheme& scheme,
                                           int threads, const Progress& progress) {
  std::vector<ModeLimit> result;
  for (const std::size_t mode : modes) {
    ModeLimit limit{mode, std::vector<std::vector<StabilityCrossing>>(revolutions_per_s.size())};
    const TipStructure structure = tip_structure(dynamics::chosen_modes(model, {mode}), cutter.is_axial());
    if (structure.modes() > 0) {
      limit.crossings =
          stability_chart(structure, cutter, revolutions_per_s, depths_m, scheme, false, threads).crossings;
    }
    for (auto& crossings : limit.crossings) {
      for (StabilityCrossing& crossing : crossings) crossing.mode = mode;
    }
    result.push_back(std::move(limit));
    if (progress) progress(static_cast<double>(result.size()) / static_cast<double>(modes.size()));
  }
  return result;
}

}  // namespace stablecut::milling
