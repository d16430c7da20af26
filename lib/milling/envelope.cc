#include "milling/envelope.h"

#include <algorithm>
#include <limits>

namespace stablecut::milling {
namespace {

// Of one speed: where the number of structures that are unstable becomes 0 or is 0 no longer.
std::vector<StabilityCrossing> common(const std::vector<StabilityChart>& charts, std::size_t speed) {
  std::vector<StabilityCrossing> all;
  for (std::size_t t = 0; t < charts.size(); ++t) {
    for (StabilityCrossing crossing : charts[t].crossings[speed]) {
      crossing.table = t;
      all.push_back(crossing);
    }
  }
  std::stable_sort(all.begin(), all.end(), [](const StabilityCrossing& a, const StabilityCrossing& b) {
    return a.depth_m < b.depth_m;
  });
  std::vector<StabilityCrossing> result;
  int unstable = 0;
  for (const StabilityCrossing& crossing : all) {
    const int after = unstable + (crossing.unstable_above ? 1 : -1);
    if ((after > 0) != (unstable > 0)) result.push_back(crossing);
    unstable = after;
  }
  return result;
}

}  // namespace

StabilityChart envelope_of(const std::vector<StabilityChart>& charts) {
  StabilityChart envelope = charts.front();
  for (std::size_t s = 0; s < envelope.error.size(); ++s) {
    for (const StabilityChart& chart : charts) {
      envelope.error[s] = std::max(envelope.error[s], chart.error[s]);
      envelope.resolution[s] = std::max(envelope.resolution[s], chart.resolution[s]);
      if (envelope.failure[s].empty()) envelope.failure[s] = chart.failure[s];
      if (envelope.spectral_radius.size() > 0)
        envelope.spectral_radius.col(s) =
            envelope.spectral_radius.col(s).cwiseMax(chart.spectral_radius.col(s));
    }
    if (envelope.failure[s].empty()) {
      envelope.crossings[s] = common(charts, s);
      continue;
    }
    // Nothing is known of all where one is not known.
    envelope.crossings[s].clear();
    envelope.resolution[s] = 0;
    if (envelope.spectral_radius.size() > 0)
      envelope.spectral_radius.col(s).setConstant(std::numeric_limits<double>::quiet_NaN());
  }
  return envelope;
}

}  // namespace stablecut::milling
