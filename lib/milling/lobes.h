// Stability charts: spectral radii over speeds and depths, and the limit depth at each speed.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "base/progress.h"
#include "milling/cutter.h"
#include "milling/floquet.h"

namespace stablecut {

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
  int resolution = 0;  ///< points per arc, or intervals
};

/// The map at one speed, good for depths up to `largest_depth_m`. The structure must outlive it. Throws
/// NoAnswer when the speed is so low that the fastest mode cannot be followed through one cut.
PreparedPeriod prepare_period(const TipStructure& structure, const Cutter& cutter, double revolutions_per_s,
                              const StabilityScheme& scheme, double largest_depth_m);

/// Where the spectral radius passes 1.
struct StabilityLimit {
  double depth_m = 0;
  CriticalMultiplier critical;
};

struct StabilityChart {
  Eigen::MatrixXd spectral_radius;  ///< [depths x speeds], of one tooth period; empty if unasked
  std::vector<std::optional<StabilityLimit>> limit;  ///< [speeds]
  double error = 0;                                  ///< largest estimated error of the spectral radius
  int least_resolution = 0;                          ///< points per arc or intervals, over the speeds
  int largest_resolution = 0;
};

/// Depths increasing, at least one. Without `with_grid` only the limit is computed.
StabilityChart stability_chart(const TipStructure& structure, const Cutter& cutter,
                               const std::vector<double>& revolutions_per_s,
                               const std::vector<double>& depths_m, const StabilityScheme& scheme,
                               bool with_grid, int threads, const Progress& progress = {});

}  // namespace stablecut
