// The limit depths at one speed, without a grid. README.md, "Limits from the unit circle".
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "milling/cutter.h"
#include "milling/floquet.h"
#include "milling/period.h"
#include "milling/structure.h"

namespace stablecut::milling {

/// Where the spectral radius passes 1, and what chatters there.
struct StabilityCrossing {
  double depth_m = 0;
  bool unstable_above = true;  ///< false: stable again above
  Instability kind = Instability::kHopf;
  double chatter_frequency_hz = 0;
  int lobe = 0;              ///< lobe_number at the mean pitch
  std::size_t mode = 0;      ///< of the model: the one with the largest share in the tip's motion
  double participation = 0;  ///< that share
  std::size_t table = 0;     ///< of a chart for several structures: the one that chatters
};

/// The limits of one speed.
struct SpeedLimits {
  std::vector<StabilityCrossing> crossings;  ///< by depth: all of them
  double error = 0;                          ///< estimated, of the multipliers that pass the unit circle
  int resolution = 0;                        ///< points on the longest piece of the cut, or intervals
};

/// All crossings between depth 0 and `largest_depth_m` > 0. With `points` on the longest piece, whose error
/// is not looked at; without, with as many as it takes. Throws as prepare_period.
SpeedLimits speed_limits(const TipStructure& structure, const Cutter& cutter, double revolutions_per_s,
                         double largest_depth_m, std::optional<int> points = {});
/// From a period that has been prepared for that depth, by a scan over the depths.
SpeedLimits scanned_limits(const PreparedPeriod& period, double largest_depth_m, double tooth_period_s);

/// The lowest depth at which the cut loses stability; none where it is stable to the top.
const StabilityCrossing* limit_of(const std::vector<StabilityCrossing>& crossings);

/// The number of a lobe: whole waves that the chatter leaves on the surface between a tooth and the next.
int lobe_number(double chatter_frequency_hz, double tooth_period_s);

/// The lowest limit below a depth at one speed; none where the cut is stable to there. With `resolution`
/// points on the longest piece (or intervals), whose error is not checked, and DepthScan::kForLimits: an
/// island of instability in which the radius exceeds 1 by less than 1e-4 may be missed.
std::optional<double> limit_depth(const TipStructure& structure, const Cutter& cutter,
                                  double revolutions_per_s, StabilityMethod method, int resolution,
                                  double largest_depth_m);

}  // namespace stablecut::milling
