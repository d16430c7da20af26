// What to run, from a chart: the depth that is stable at every speed, and the best points. README.md, "What
// to run".
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "milling/cutter.h"
#include "milling/lobes.h"
#include "milling/operating_points.h"
#include "milling/structure.h"
#include "milling/surface.h"

namespace stablecut::milling {

/// The limit depth over the speed as a chart has it.
struct LimitCurve {
  std::vector<LimitPoint> points;  ///< by increasing speed
  std::vector<int> resolution;     ///< as StabilityChart's, of each point
  StabilityMethod method = StabilityMethod::kSpectral;
  double largest_depth_m = 0;
};
LimitCurve limit_curve(const StabilityChart& chart, const std::vector<double>& revolutions_per_s,
                       StabilityMethod method, double largest_depth_m);

/// Of the surfaces that cuts leave.
struct SurfaceRequest {
  Eigen::Matrix2d added_compliance = Eigen::Matrix2d::Zero();  ///< as SurfaceAtSpeed's
  std::optional<double> largest_error_m;                       ///< of the wall's location, either way
};

/// What is asked of the best points.
struct RunRequest {
  std::size_t count = 5;            ///< points at most
  double depth_share = 0.1;         ///< as OperatingLimits'
  double speed_share = 0.02;        ///< as OperatingLimits'
  std::optional<CuttingLoad> load;  ///< needed for rates; then the cutter has a diameter
  std::optional<double> largest_power_w, largest_torque_n_m;  ///< need the load
  std::optional<SurfaceRequest> surface;                      ///< needs the load; of the first structure
};

struct WhatToRun {
  /// The lowest limit of all speeds; none: stable to the largest depth.
  std::optional<LimitPoint> unconditional;
  std::vector<LimitPoint> between;     ///< limits between the curve's speeds, by speed
  OperatingLimits limits;              ///< that the best points keep
  std::vector<OperatingPoint> best;    ///< best first
  std::vector<CutRate> rates;          ///< of the best; empty without a feed
  std::vector<SurfacePoint> surfaces;  ///< of the best; empty where not asked for
};

/// Stable for all structures. Limits between the curve's speeds are computed with as many points or intervals
/// as the curve's speed below needed. The curve has at least one point.
WhatToRun what_to_run(const std::vector<TipStructure>& structures, const Cutter& cutter,
                      const LimitCurve& curve, const RunRequest& request, int threads);

}  // namespace stablecut::milling
