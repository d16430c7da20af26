// What to run: depths that are stable at every speed, and the best points below the limit curve.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "milling/cutter.h"
#include "milling/cutting_force.h"
#include "milling/structure.h"

namespace stablecut::milling {

/// A limit depth at a speed; no depth: stable to the largest one.
struct LimitPoint {
  double revolutions_per_s = 0;
  std::optional<double> depth_m;
  bool known = true;  ///< false: the speed could not be resolved, and nothing is known there
};

/// The limit at a speed (revolutions/s), as far as it lies below a depth. Where a speed cannot be resolved,
/// no cut is stable: depth 0.
using LimitAt = std::function<std::optional<double>(double revolutions_per_s, double largest_depth_m)>;

/// Speeds between those of a chart (increasing, revolutions/s), so that neighbours are no farther apart than
/// the narrowest features that matter: the damping ratio of each mode whose own share in limits of `depth_m`
/// is more than a few per cent. At most `most` of them. README.md, "What to run".
std::vector<double> speeds_between(const std::vector<TipStructure>& structures, const Cutter& cutter,
                                   const std::vector<double>& chart, double depth_m, std::size_t most);

/// The lowest limit over all speeds of a curve, between its speeds too: around each minimum that is not far
/// above the lowest. A lobe that no speed of the curve lies in is missed. None when every speed is stable to
/// the largest depth. `curve` by increasing speed; `limit_at` may be called from several threads.
std::optional<LimitPoint> unconditional_limit(const std::vector<LimitPoint>& curve, const LimitAt& limit_at,
                                              int threads);

/// What a cut removes, and the power and torque that it takes on the mean: Kt times the chip's volume and the
/// work of the edge forces [Altintas2012].
struct CutRate {
  double removal_m3_per_s = 0;
  double power_w = 0;
  double torque_n_m = 0;
};
/// The cutter's diameter must be set; the width of cut is that of the entry and exit angles.
CutRate cut_rate(const Cutter& cutter, const CuttingLoad& load, double revolutions_per_s, double depth_m);

struct OperatingLimits {
  double largest_depth_m = 0;
  double depth_share = 0.1;   ///< of the limit depth, kept as a margin below it
  double speed_share = 0.02;  ///< of the speed, to either side: the point is stable there too
  std::optional<double> largest_depth_times_speed;  ///< m/s: what the power allows
  std::optional<double> largest_depth_by_torque;    ///< m
  /// How deep a cut may be at a speed, up to a depth (what its surface allows); empty: any. May be called
  /// from several threads.
  std::function<double(double revolutions_per_s, double depth_m)> allowed_depth;
};

struct OperatingPoint {
  double revolutions_per_s = 0;
  double depth_m = 0;
  std::optional<double> limit_m;    ///< at this speed
  double slowest = 0, fastest = 0;  ///< revolutions/s: the depth was stable at every step between them
  /// The curve ends within the margin of speed: a better point may lie beyond it, and chatter too.
  bool at_edge = false;
};

/// At most `count` points of largest removal rate (depth times speed), best first. At each of the curve's
/// speeds the deepest cut inside the limits is taken, and of these the ones that are better than their
/// neighbours. Then limits are looked at in quarters of the speed margin to either side (those of the curve
/// where it has a speed near, else computed), and the depth is lowered where they ask for it; and further out
/// it is seen how far the cut stays stable, up to three margins or the curve's end. Empty when no depth is
/// stable at any speed. `curve` by increasing speed; `limit_at` may be called from several threads.
std::vector<OperatingPoint> best_points(const std::vector<LimitPoint>& curve, const OperatingLimits& limits,
                                        std::size_t count, const LimitAt& limit_at, int threads);

}  // namespace stablecut::milling
