#include "document/lobes.h"

#include <algorithm>

#include "base/units.h"

namespace stablecut {
namespace {

const char* instability_name(Instability kind) {
  switch (kind) {
    case Instability::kHopf:
      return "hopf";
    case Instability::kFlip:
      return "flip";
    case Instability::kFold:
      return "fold";
  }
  return "";
}

Json limit_to_json(const std::vector<double>& speed_rpm,
                   const std::vector<std::optional<StabilityLimit>>& limit) {
  Json list = Json::array();
  for (std::size_t s = 0; s < speed_rpm.size(); ++s) {
    Json item = {{"speed_rpm", speed_rpm[s]}, {"depth_mm", nullptr}};
    if (limit[s]) {
      item["depth_mm"] = mm_from_metres(limit[s]->depth_m);
      item["chatter_frequency_hz"] = limit[s]->critical.chatter_frequency_hz;
      item["kind"] = instability_name(limit[s]->critical.kind);
    }
    list.push_back(std::move(item));
  }
  return list;
}

Json point_to_json(const JudgedCut& point) {
  const bool stable = is_stable(point.spectral_radius);
  Json item = {{"depth_mm", point.cut.depth_mm},
               {"speed_rpm", point.cut.speed_rpm},
               {"spectral_radius", point.spectral_radius},
               {"stable", stable}};
  if (point.cut.observed_stable) {
    item["observed"] = *point.cut.observed_stable ? "stable" : "chatter";
    item["agrees"] = *point.cut.observed_stable == stable;
  }
  return item;
}

}  // namespace

Json lobes_to_json(const LobesDocument& lobes) {
  const bool spectral = lobes.scheme.method == StabilityMethod::kSpectral;
  Json document = {{"format", "stablecut/lobes/1"},
                   {"cut", lobes.cut},
                   {"method", spectral ? "spectral" : "sdm"},
                   {"convergence", std::max(lobes.chart.error, lobes.points_error)}};
  if (spectral) {
    document["points_per_arc"] = {{"least", lobes.chart.least_resolution},
                                  {"largest", lobes.chart.largest_resolution}};
  } else {
    document["intervals"] = lobes.scheme.intervals;
  }
  document["speed_rpm"] = lobes.speed_rpm;
  document["depth_mm"] = lobes.depth_mm;
  if (const auto& radius = lobes.chart.spectral_radius; radius.size() > 0) {
    Json rows = Json::array();
    for (Eigen::Index d = 0; d < radius.rows(); ++d) {
      rows.push_back(std::vector<double>(radius.row(d).begin(), radius.row(d).end()));
    }
    document["spectral_radius"] = std::move(rows);
  }
  document["limit"] = limit_to_json(lobes.speed_rpm, lobes.chart.limit);
  if (!lobes.per_mode.empty()) {
    Json list = Json::array();
    for (const ModeLimit& mode : lobes.per_mode) {
      list.push_back({{"mode", mode.mode}, {"limit", limit_to_json(lobes.speed_rpm, mode.limit)}});
    }
    document["per_mode"] = std::move(list);
  }
  if (!lobes.points.empty()) {
    Json list = Json::array();
    for (const JudgedCut& point : lobes.points) list.push_back(point_to_json(point));
    document["points"] = std::move(list);
  }
  return document;
}

}  // namespace stablecut
