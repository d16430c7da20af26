#include "critical_modes.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "base/number_text.h"
#include "base/units.h"

namespace stablecut {
namespace {

constexpr double kNoDamping = 1e-4;  // no assembled structure has a damping ratio below
constexpr double kDeviations = 2;    // between which and zero a number is not sure

std::optional<std::string> doubt(const dynamics::ModalModel& table, std::size_t k) {
  const dynamics::Mode& mode = table.modes[k];
  if (mode.out_of_band) return "lies outside the measured band, which hardly shows its damping";
  if (mode.damping_ratio < kNoDamping)
    return "has a damping ratio of " + number_text(mode.damping_ratio, 3) +
           ", as no structure has: a disturbed line?";
  if (table.covariance.size() == 0) return std::nullopt;
  const Eigen::VectorXd deviation = table.deviation(static_cast<Eigen::Index>(k));
  if (kDeviations * deviation[1] > mode.damping_ratio)
    return "has a damping ratio of " + number_text(mode.damping_ratio, 3) + " with a standard deviation of " +
           number_text(deviation[1], 3);
  if (deviation[0] > mode.damping_ratio * mode.frequency_hz)
    return "has a frequency that is less sure (" + number_text(deviation[0], 3) +
           " Hz) than its resonance is wide";
  return std::nullopt;
}

}  // namespace

std::vector<std::string> doubtful_critical_modes(const milling::StabilityChart& chart,
                                                 const std::vector<dynamics::ModalModel>& tables) {
  // The least limit of each critical mode: by table and mode.
  std::map<std::pair<std::size_t, std::size_t>, double> least;
  for (const auto& crossings : chart.crossings) {
    const milling::StabilityCrossing* limit = milling::limit_of(crossings);
    if (limit == nullptr) continue;
    const auto [at, is_new] = least.try_emplace({limit->table, limit->mode}, limit->depth_m);
    if (!is_new) at->second = std::min(at->second, limit->depth_m);
  }
  std::vector<std::string> lines;
  for (const auto& [which, depth_m] : least) {
    const auto [table, k] = which;
    const auto text = doubt(tables[table], k);
    if (!text) continue;
    lines.push_back("mode " + std::to_string(k + 1) + " (" +
                    number_text(tables[table].modes[k].frequency_hz, 3) + " Hz) limits the depth down to " +
                    number_text(mm_from_metres(depth_m), 3) + " mm, but " + *text);
  }
  return lines;
}

}  // namespace stablecut
