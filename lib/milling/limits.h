// The limit depths at one speed, without a grid. README.md, "Limits from the unit circle".
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "milling/cutter.h"
#include "milling/depth_scan.h"
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

/// All crossings between depth 0 and `largest_depth_m` > 0, with as many points as it takes, from the unit
/// circle. Nothing where the cut is not one for it (helical teeth, very many rows, a structure that is
/// unstable by itself) or where the count does not confirm them; then a scan over the depths has them. Throws
/// NoAnswer as point_plan, and where the limits do not converge.
std::optional<SpeedLimits> circle_limits(const TipStructure& structure, const Cutter& cutter,
                                         double revolutions_per_s, double largest_depth_m);
/// Those of a scan over the depths of a map.
std::vector<StabilityCrossing> scanned_crossings(const DepthScan& scan, const PeriodMap& map,
                                                 double tooth_period_s);
/// Either, with `points` on the longest piece, whose error is not looked at. Throws NoAnswer where a scan
/// cannot follow the multipliers.
std::vector<StabilityCrossing> crossings_at(const TipStructure& structure, const Cutter& cutter,
                                            double revolutions_per_s, double largest_depth_m, int points);

/// The lowest depth at which the cut loses stability; none where it is stable to the top.
const StabilityCrossing* limit_of(const std::vector<StabilityCrossing>& crossings);

/// Whether a depth up to the largest is stable: up to the first crossing, and between a second and a third.
bool stable_between(const std::vector<StabilityCrossing>& crossings, double depth_m);

/// The number of a lobe: whole waves that the chatter leaves on the surface between a tooth and the next.
int lobe_number(double chatter_frequency_hz, double tooth_period_s);

/// The lowest limit below a depth at one speed; none where the cut is stable to there. With `resolution`
/// points on the longest piece (or intervals), whose error is not checked.
std::optional<double> limit_depth(const TipStructure& structure, const Cutter& cutter,
                                  double revolutions_per_s, StabilityMethod method, int resolution,
                                  double largest_depth_m);

}  // namespace stablecut::milling
