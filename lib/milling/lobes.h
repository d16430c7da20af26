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
  kSpectral,            ///< collocation on the engaged arcs, refined until it has converged
  kSemiDiscretization,  ///< the thesis's scheme at a given number of intervals
};

struct StabilityScheme {
  StabilityMethod method = StabilityMethod::kSpectral;
  int intervals = 40;  ///< m, for the semi-discretization
};

/// A period map at one speed with what is known of its error.
struct PreparedPeriod {
  std::unique_ptr<PeriodMap> map;
  /// Estimated error of the spectral radius, of max(1, radius): the change when points are added (spectral),
  /// or the distance to the spectral method (semi-discretization), the worst of a few depths.
  double error = 0;
  int resolution = 0;  ///< points on the longest arc, or intervals
};

/// The map at one speed, good for depths up to `largest_depth_m` (but not where the radius is far above 1).
/// The structure must outlive it. Throws NoAnswer when the speed is so low that the fastest mode cannot be
/// followed through one cut, or when the radius does not converge.
PreparedPeriod prepare_period(const TipStructure& structure, const Cutter& cutter, double revolutions_per_s,
                              const StabilityScheme& scheme, double largest_depth_m);

/// Where the spectral radius passes 1, and what chatters there.
struct StabilityCrossing {
  double depth_m = 0;
  bool unstable_above = true;  ///< false: stable again above
  Instability kind = Instability::kHopf;
  double chatter_frequency_hz = 0;
  int lobe = 0;          ///< whole waves that the chatter leaves between a tooth and the next (mean pitch)
  std::size_t mode = 0;  ///< of the model: the one with the largest part in the tip's motion
  double participation = 0;  ///< that part, of the motion
};

struct StabilityChart {
  Eigen::MatrixXd spectral_radius;  ///< [depths x speeds], of one tooth period; empty if unasked
  std::vector<std::vector<StabilityCrossing>> crossings;  ///< [speeds], by depth: all of them
  std::vector<double> error;                              ///< [speeds] estimated, of the spectral radius
  std::vector<int> resolution;  ///< [speeds] points on the longest arc, or intervals
};

/// The lowest depth at which the cut loses stability; none where it is stable to the top.
const StabilityCrossing* limit_of(const std::vector<StabilityCrossing>& crossings);

/// The lowest limit below a depth at one speed, with so many points on the longest arc (or intervals) and not
/// checked further; none where it is stable to there. Some 1e-4 of the radius may hide an island.
std::optional<double> limit_depth(const TipStructure& structure, const Cutter& cutter,
                                  double revolutions_per_s, StabilityMethod method, int resolution,
                                  double largest_depth_m);

/// Depths increasing, at least one; crossings are looked for from 0 to the largest. Without `with_grid` only
/// the crossings are computed.
StabilityChart stability_chart(const TipStructure& structure, const Cutter& cutter,
                               const std::vector<double>& revolutions_per_s,
                               const std::vector<double>& depths_m, const StabilityScheme& scheme,
                               bool with_grid, int threads, const Progress& progress = {});

}  // namespace stablecut::milling
