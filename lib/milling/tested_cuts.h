// Cuts that were tried on the machine, against what the model says of them.
#pragma once

#include <optional>
#include <vector>

#include "milling/cutter.h"
#include "milling/period.h"
#include "milling/structure.h"

namespace stablecut::milling {

struct TestedCut {
  double revolutions_per_s = 0;
  double depth_m = 0;
  std::optional<bool> observed_stable;  ///< none: not observed
};

/// What the model says of a tested cut.
struct JudgedCut {
  double spectral_radius = 0;  ///< of one tooth period
  double error = 0;            ///< of it, as PreparedPeriod's
  bool stable = false;         ///< a spectral radius below 1
  std::optional<bool> agrees;  ///< with what was observed
};

/// One verdict for each cut, each at its own speed and depth, of the structure with the largest radius there.
/// Throws as prepare_period.
std::vector<JudgedCut> judged_cuts(const std::vector<TestedCut>& cuts,
                                   const std::vector<TipStructure>& structures, const Cutter& cutter,
                                   const StabilityScheme& scheme, int threads);

}  // namespace stablecut::milling
