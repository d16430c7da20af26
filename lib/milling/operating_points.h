// What to run: depths that are stable at every speed, and the best points below the limit curve.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "milling/cutter.h"
#include "milling/structure.h"

namespace stablecut::milling {

/// A limit depth at a speed; no depth: stable to the largest one.
struct LimitPoint {
  double revolutions_per_s = 0;
  std::optional<double> depth_m;
};

/// The limit at a speed (revolutions/s), as far as it lies below a depth.
using LimitAt = std::function<std::optional<double>(double revolutions_per_s, double largest_depth_m)>;

/// A speed at which a narrow lobe may reach below the chart's points, and the share of it within which.
struct NarrowLobe {
  double revolutions_per_s = 0;
  double width = 0;
};

/// Where a mode turns an odd number of half times in a period, it may flip: just above such speeds, within a
/// few damping ratios. Those between two speeds (revolutions/s).
std::vector<NarrowLobe> possible_flips(const TipStructure& structure, const Cutter& cutter, double from,
                                       double to);

/// The lowest limit over all speeds of the chart, searched between its speeds: around the lowest few minima,
/// and at narrow lobes. None when every speed is stable to the largest depth. `limit_at` may be called from
/// several threads.
std::optional<LimitPoint> unconditional_limit(const std::vector<LimitPoint>& chart, double largest_depth_m,
                                              const std::vector<NarrowLobe>& narrow, const LimitAt& limit_at,
                                              int threads);

/// What a cut removes and takes. The chip's volume times Kt is the cutting work (no edge forces).
struct CutRate {
  double removal_m3_per_s = 0;
  double power_w = 0;
  double torque_n_m = 0;
};
/// Needs the diameter; the engaged width is that of the entry and exit angles.
CutRate cut_rate(const Cutter& cutter, double feed_per_tooth_m, double revolutions_per_s, double depth_m);

struct OperatingLimits {
  double largest_depth_m = 0;
  double depth_share = 0.1;   ///< of the limit depth, kept as a margin
  double speed_share = 0.02;  ///< of the speed, to either side: the depth is stable there too
  /// Largest removal rate (Kt times it is the power) and volume per turn (Kt times it over 2 pi is the
  /// torque), in units of depth times speed and of depth; none: unlimited.
  std::optional<double> largest_depth_times_speed, largest_depth_by_torque;
};

struct OperatingPoint {
  double revolutions_per_s = 0;
  double depth_m = 0;
  std::optional<double> limit_m;    ///< at this speed
  double slowest = 0, fastest = 0;  ///< this depth was found stable at every step between them
};

/// The best `count` points by depth times speed, that is by removal rate, best first: at each of the chart's
/// speeds the deepest cut inside the limits; of neighbouring speeds only the best. Then the limit is computed
/// in quarters of the margin to either side and the depth lowered where it needs to be, and further steps of
/// half the margin are taken as long as they are stable, to three margins or the chart's end. Empty when no
/// depth is stable at any speed. `limit_at` may be called from several threads.
std::vector<OperatingPoint> best_points(const std::vector<LimitPoint>& chart, const OperatingLimits& limits,
                                        std::size_t count, const LimitAt& limit_at, int threads);

}  // namespace stablecut::milling
