#include "milling/tested_cuts.h"

#include <algorithm>

#include "base/parallel.h"
#include "milling/floquet.h"

namespace stablecut::milling {

std::vector<JudgedCut> judged_cuts(const std::vector<TestedCut>& cuts,
                                   const std::vector<TipStructure>& structures, const Cutter& cutter,
                                   const StabilityScheme& scheme, int threads) {
  std::vector<JudgedCut> judged(cuts.size());
  parallel_for(cuts.size(), threads, [&](std::size_t i) {
    const TestedCut& cut = cuts[i];
    JudgedCut& verdict = judged[i];
    for (const TipStructure& structure : structures) {
      const PreparedPeriod period =
          prepare_period(structure, cutter, cut.revolutions_per_s, scheme, cut.depth_m);
      verdict.spectral_radius = std::max(verdict.spectral_radius, spectral_radius(*period.map, cut.depth_m));
      verdict.error = std::max(verdict.error, period.error);
    }
    verdict.stable = verdict.spectral_radius < 1;
    if (cut.observed_stable) verdict.agrees = *cut.observed_stable == verdict.stable;
  });
  return judged;
}

}  // namespace stablecut::milling
