#include "critical_modes.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "base/error.h"
#include "base/number_text.h"
#include "base/units.h"
#include "document/kinds/modal_table_json.h"
#include "document/text/data_error.h"

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

// Indices from 0 as --modes takes them: 2-7,9.
std::string mode_list(const std::vector<std::size_t>& modes) {
  std::string text;
  for (std::size_t i = 0; i < modes.size(); ++i) {
    std::size_t last = i;
    while (last + 1 < modes.size() && modes[last + 1] == modes[last] + 1) ++last;
    text += (text.empty() ? "" : ",") + std::to_string(modes[i] + 1);
    if (last > i) text += "-" + std::to_string(modes[last] + 1);
    i = last;
  }
  return text;
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

std::optional<std::string> limit_without_doubtful(const dynamics::ModalModel& table,
                                                  const std::vector<std::size_t>& modes,
                                                  const document::Source& source,
                                                  const milling::Cutter& cutter, const ChartAxes& axes,
                                                  const milling::StabilityScheme& scheme, int threads) {
  std::vector<std::size_t> sure;
  std::copy_if(modes.begin(), modes.end(), std::back_inserter(sure),
               [&](std::size_t k) { return !doubt(table, k); });
  if (sure.empty()) return std::nullopt;
  double least = std::numeric_limits<double>::infinity();
  try {
    const milling::TipStructure structure =
        document::tip_structure_of(dynamics::chosen_modes(table, sure), source, cutter.is_axial());
    const milling::StabilityChart chart = milling::stability_chart(structure, cutter, axes.revolutions_per_s,
                                                                   axes.depths_m, scheme, false, threads);
    for (const auto& crossings : chart.crossings) {
      const milling::StabilityCrossing* limit = milling::limit_of(crossings);
      if (limit != nullptr) least = std::min(least, limit->depth_m);
    }
  } catch (const document::DataError&) {  // these modes move nothing that cuts
    return std::nullopt;
  } catch (const NoAnswer&) {
    return std::nullopt;
  }
  return "the other modes alone (--modes " + mode_list(sure) + ") limit the depth " +
         (std::isfinite(least) ? "down to " + number_text(mm_from_metres(least), 3) + " mm"
                               : "nowhere in the chart");
}

}  // namespace stablecut
