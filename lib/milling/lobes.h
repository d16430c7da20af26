// Stability charts: spectral radii over speeds and depths, and the limit depth at each speed.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "base/progress.h"
#include "milling/cutter.h"
#include "milling/floquet.h"

namespace stablecut::milling {

enum class StabilityMethod {
  kSpectral,            ///< collocation on the arcs in cut, refined until it has converged
  kSemiDiscretization,  ///< the zeroth-order scheme of [RobotMillingThesis] at a given number of intervals
};

struct StabilityScheme {
  StabilityMethod method = StabilityMethod::kSpectral;
  int intervals = 40;  ///< m, for the semi-discretization
};

/// A period map at one speed with what is known of its error. README.md, "How many points".
struct PreparedPeriod {
  std::unique_ptr<PeriodMap> map;
  /// Estimated error of the spectral radius, of max(1, radius): the change when points are added (spectral),
  /// or the distance to the spectral method (semi-discretization); the largest at a few depths.
  double error = 0;
  int resolution = 0;  ///< points on the longest piece of the cut, or intervals
};

/// The map at one speed, for depths up to `largest_depth_m`; where the radius is above 100 its error is not
/// looked at. The structure must outlive the map. Throws NoAnswer, with Remedy::kModes, when the speed is so
/// low that the fastest mode cannot be followed through one cut, or when the radius does not converge.
PreparedPeriod prepare_period(const TipStructure& structure, const Cutter& cutter, double revolutions_per_s,
                              const StabilityScheme& scheme, double largest_depth_m);

/// Where the spectral radius passes 1, and what chatters there.
struct StabilityCrossing {
  double depth_m = 0;
  bool unstable_above = true;  ///< false: stable again above
  Instability kind = Instability::kHopf;
  double chatter_frequency_hz = 0;
  int lobe = 0;              ///< lobe_number at the mean pitch
  std::size_t mode = 0;      ///< of the model: the one with the largest share in the tip's motion
  double participation = 0;  ///< that share
};

struct StabilityChart {
  Eigen::MatrixXd spectral_radius;  ///< [depths x speeds], of one tooth period; empty without a grid
  std::vector<std::vector<StabilityCrossing>> crossings;  ///< [speeds], by depth: all of them
  std::vector<double> error;                              ///< [speeds] estimated, of the spectral radius
  std::vector<int> resolution;  ///< [speeds] points on the longest piece of the cut, or intervals
};

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

/// Radii at all speeds and depths, and all crossings between depth 0 and the largest. `depths_m` increasing,
/// at least one. Without `with_grid` only the crossings are computed. Throws as prepare_period, and NoAnswer
/// where a map is not finite.
StabilityChart stability_chart(const TipStructure& structure, const Cutter& cutter,
                               const std::vector<double>& revolutions_per_s,
                               const std::vector<double>& depths_m, const StabilityScheme& scheme,
                               bool with_grid, int threads, const Progress& progress = {});

}  // namespace stablecut::milling
