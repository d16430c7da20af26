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

/// A lobe that may be narrower than the chart's steps of speed.
struct NarrowLobe {
  double revolutions_per_s = 0;  ///< where it begins
  double width = 0;              ///< from there upwards, as a share of the speed
};

/// Speeds between `from` and `to` (revolutions/s) just above which a mode may flip: where its oscillations in
/// a period are a whole number and a half. The lobe is a few damping ratios wide.
std::vector<NarrowLobe> possible_flips(const TipStructure& structure, const Cutter& cutter, double from,
                                       double to);

/// The lowest limit over all speeds of the chart, between its speeds too: around its two lowest minima, and
/// in the narrow lobes. A lobe elsewhere that no speed of the chart lies in is missed. None when every speed
/// is stable to the largest depth. `chart` by increasing speed; `limit_at` may be called from several
/// threads.
std::optional<LimitPoint> unconditional_limit(const std::vector<LimitPoint>& chart, double largest_depth_m,
                                              const std::vector<NarrowLobe>& narrow, const LimitAt& limit_at,
                                              int threads);

/// What a cut removes, and the power and torque that it takes: Kt times the chip's volume is the cutting
/// work, without edge forces [Altintas2012].
struct CutRate {
  double removal_m3_per_s = 0;
  double power_w = 0;
  double torque_n_m = 0;
};
/// The cutter's diameter must be set; the width of cut is that of the entry and exit angles.
CutRate cut_rate(const Cutter& cutter, double feed_per_tooth_m, double revolutions_per_s, double depth_m);

struct OperatingLimits {
  double largest_depth_m = 0;
  double depth_share = 0.1;   ///< of the limit depth, kept as a margin below it
  double speed_share = 0.02;  ///< of the speed, to either side: the point is stable there too
  std::optional<double> largest_depth_times_speed;  ///< m/s: what the power allows
  std::optional<double> largest_depth_by_torque;    ///< m
};

struct OperatingPoint {
  double revolutions_per_s = 0;
  double depth_m = 0;
  std::optional<double> limit_m;    ///< at this speed
  double slowest = 0, fastest = 0;  ///< revolutions/s: the depth was stable at every step between them
};

/// At most `count` points of largest removal rate (depth times speed), best first. At each of the chart's
/// speeds the deepest cut inside the limits is taken, and of these the ones that are better than their
/// neighbours. Then limits are computed at quarters of the speed margin to either side, also between the
/// chart's speeds, and the depth is lowered where they ask for it; and in steps of half a margin further out
/// it is seen how far the cut stays stable, up to three margins or the chart's end. Empty when no depth is
/// stable at any speed. `chart` by increasing speed; `limit_at` may be called from several threads.
std::vector<OperatingPoint> best_points(const std::vector<LimitPoint>& chart, const OperatingLimits& limits,
                                        std::size_t count, const LimitAt& limit_at, int threads);

}  // namespace stablecut::milling
