#include "milling/what_to_run.h"

#include <algorithm>

namespace stablecut::milling {
namespace {

OperatingLimits limits_of(const RunRequest& request, const Cutter& cutter, double largest_depth_m) {
  OperatingLimits limits;
  limits.largest_depth_m = largest_depth_m;
  limits.depth_share = request.depth_share;
  limits.speed_share = request.speed_share;
  if (request.feed_per_tooth_m) {
    // Power is proportional to depth times speed, and torque to depth.
    const CutRate unit = cut_rate(cutter, *request.feed_per_tooth_m, 1, 1);
    if (request.largest_power_w) limits.largest_depth_times_speed = *request.largest_power_w / unit.power_w;
    if (request.largest_torque_n_m)
      limits.largest_depth_by_torque = *request.largest_torque_n_m / unit.torque_n_m;
  }
  return limits;
}

}  // namespace

LimitCurve limit_curve(const StabilityChart& chart, const std::vector<double>& revolutions_per_s,
                       StabilityMethod method, double largest_depth_m) {
  LimitCurve curve{{}, chart.resolution, method, largest_depth_m};
  for (std::size_t s = 0; s < revolutions_per_s.size(); ++s) {
    const StabilityCrossing* limit = limit_of(chart.crossings[s]);
    curve.points.push_back(
        {revolutions_per_s[s], limit != nullptr ? std::optional(limit->depth_m) : std::nullopt});
  }
  return curve;
}

WhatToRun what_to_run(const TipStructure& structure, const Cutter& cutter, const LimitCurve& curve,
                      const RunRequest& request, int threads) {
  const LimitAt limit_at = [&](double speed, double largest_depth_m) {
    // Lower speeds need more points.
    const auto above =
        std::upper_bound(curve.points.begin(), curve.points.end(), speed,
                         [](double value, const LimitPoint& p) { return value < p.revolutions_per_s; });
    const auto below = std::max<std::ptrdiff_t>(above - curve.points.begin() - 1, 0);
    return limit_depth(structure, cutter, speed, curve.method, curve.resolution[below], largest_depth_m);
  };
  const double slowest = curve.points.front().revolutions_per_s;
  const double fastest = curve.points.back().revolutions_per_s;
  WhatToRun what;
  what.unconditional =
      unconditional_limit(curve.points, curve.largest_depth_m,
                          possible_flips(structure, cutter, slowest, fastest), limit_at, threads);
  what.limits = limits_of(request, cutter, curve.largest_depth_m);
  what.best = best_points(curve.points, what.limits, request.count, limit_at, threads);
  if (request.feed_per_tooth_m) {
    for (const OperatingPoint& point : what.best)
      what.rates.push_back(
          cut_rate(cutter, *request.feed_per_tooth_m, point.revolutions_per_s, point.depth_m));
  }
  return what;
}

}  // namespace stablecut::milling
