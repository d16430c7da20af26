#include "milling/what_to_run.h"

#include <algorithm>

#include "base/error.h"
#include "base/parallel.h"

namespace stablecut::milling {
namespace {

// Limits between the curve's speeds: so many for each of them at most, and so many at least; where a limit is
// dear, one for so many.
constexpr std::size_t kMostBetween = 4, kLeastBetween = 400, kSpeedsForOneDear = 4;
// A limit with more rows is dear, and so is one of helical teeth, unequal pitches or process damping.
constexpr int kCheapRows = 48;

OperatingLimits limits_of(const RunRequest& request, const Cutter& cutter, double largest_depth_m) {
  OperatingLimits limits;
  limits.largest_depth_m = largest_depth_m;
  limits.depth_share = request.depth_share;
  limits.speed_share = request.speed_share;
  if (request.load) {
    // Power is proportional to depth times speed, and torque to depth; at a corner the edge forces are a
    // little larger at smaller depths.
    CutRate unit = cut_rate(cutter, *request.load, 1, largest_depth_m);
    unit.power_w /= largest_depth_m;
    unit.torque_n_m /= largest_depth_m;
    if (request.largest_power_w) limits.largest_depth_times_speed = *request.largest_power_w / unit.power_w;
    if (request.largest_torque_n_m)
      limits.largest_depth_by_torque = *request.largest_torque_n_m / unit.torque_n_m;
  }
  return limits;
}

// Of the curve's speed below: lower speeds need more points.
int resolution_at(const LimitCurve& curve, double revolutions_per_s) {
  const auto above =
      std::upper_bound(curve.points.begin(), curve.points.end(), revolutions_per_s,
                       [](double value, const LimitPoint& p) { return value < p.revolutions_per_s; });
  return curve.resolution[std::max<std::ptrdiff_t>(above - curve.points.begin() - 1, 0)];
}

// Limits at speeds between the curve's, as many as they are worth.
std::vector<LimitPoint> limits_between(const std::vector<TipStructure>& structures, const Cutter& cutter,
                                       const LimitCurve& curve, const LimitAt& limit_at, int threads) {
  std::vector<double> speeds;
  double lowest = curve.largest_depth_m;
  for (const LimitPoint& point : curve.points) {
    speeds.push_back(point.revolutions_per_s);
    if (point.depth_m) lowest = std::min(lowest, *point.depth_m);
  }
  const int points = *std::max_element(curve.resolution.begin(), curve.resolution.end());
  const bool one_in_cut = cutter.exit_rad - cutter.entry_rad <= cutter.mean_pitch_rad();
  const bool cheap = curve.method == StabilityMethod::kSpectral && cutter.equal_pitch() &&
                     !cutter.changes_with_depth() && cutter.damping_n_per_m == 0 &&
                     points * (one_in_cut ? 1 : 2) <= kCheapRows;
  const std::size_t most =
      cheap ? kMostBetween * speeds.size() + kLeastBetween : speeds.size() / kSpeedsForOneDear;
  std::vector<LimitPoint> between;
  for (const double speed : speeds_between(structures, cutter, speeds, lowest, most))
    between.push_back({speed, {}});
  parallel_for(between.size(), threads, [&](std::size_t i) {
    LimitPoint& point = between[i];
    const auto limit = limit_at(point.revolutions_per_s, curve.largest_depth_m);
    point.known = !limit || *limit > 0;
    if (point.known) point.depth_m = limit;
  });
  return between;
}

}  // namespace

LimitCurve limit_curve(const StabilityChart& chart, const std::vector<double>& revolutions_per_s,
                       StabilityMethod method, double largest_depth_m) {
  LimitCurve curve{{}, chart.resolution, method, largest_depth_m};
  for (std::size_t s = 0; s < revolutions_per_s.size(); ++s) {
    const StabilityCrossing* limit = limit_of(chart.crossings[s]);
    curve.points.push_back({revolutions_per_s[s],
                            limit != nullptr ? std::optional(limit->depth_m) : std::nullopt,
                            chart.failure.empty() || chart.failure[s].empty()});
  }
  return curve;
}

WhatToRun what_to_run(const std::vector<TipStructure>& structures, const Cutter& cutter,
                      const LimitCurve& curve, const RunRequest& request, int threads) {
  const LimitAt limit_at = [&](double speed, double largest_depth_m) -> std::optional<double> {
    const int resolution = resolution_at(curve, speed);
    if (resolution == 0) return 0.0;
    try {
      std::optional<double> lowest;
      for (const TipStructure& structure : structures) {
        const double top = lowest.value_or(largest_depth_m);
        const auto limit = limit_depth(structure, cutter, speed, curve.method, resolution, top);
        if (limit) lowest = limit;
      }
      return lowest;
    } catch (const NoAnswer&) {
      return 0.0;
    } catch (const InvalidArgument&) {
      return 0.0;
    }
  };
  WhatToRun what;
  what.between = limits_between(structures, cutter, curve, limit_at, threads);
  std::vector<LimitPoint> all = curve.points;
  all.insert(all.end(), what.between.begin(), what.between.end());
  const auto by_speed = [](const LimitPoint& a, const LimitPoint& b) {
    return a.revolutions_per_s < b.revolutions_per_s;
  };
  std::sort(all.begin(), all.end(), by_speed);
  // A speed that cannot be resolved does not decide what is stable at all others.
  const LimitAt known_limit_at = [&](double speed, double largest_depth_m) {
    const auto limit = limit_at(speed, largest_depth_m);
    return limit && *limit == 0 ? std::nullopt : limit;
  };
  what.unconditional = unconditional_limit(all, known_limit_at, threads);
  if (what.unconditional) {
    what.between.push_back(*what.unconditional);
    std::sort(what.between.begin(), what.between.end(), by_speed);
  }
  what.limits = limits_of(request, cutter, curve.largest_depth_m);
  OperatingLimits limits = what.limits;
  const auto surface_at = [&](double speed) {
    return SurfaceAtSpeed(structures.front(), cutter, *request.load, speed, resolution_at(curve, speed),
                          request.surface->added_compliance);
  };
  if (request.surface && request.surface->largest_error_m) {
    limits.allowed_depth = [&](double speed, double depth_m) {
      return surface_at(speed).deepest_within(*request.surface->largest_error_m, depth_m);
    };
  }
  what.best = best_points(all, limits, request.count, limit_at, threads);
  if (request.load) {
    for (const OperatingPoint& point : what.best)
      what.rates.push_back(cut_rate(cutter, *request.load, point.revolutions_per_s, point.depth_m));
  }
  if (request.surface) {
    for (const OperatingPoint& point : what.best)
      what.surfaces.push_back(surface_at(point.revolutions_per_s).at(point.depth_m));
  }
  return what;
}

}  // namespace stablecut::milling
