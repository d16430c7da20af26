// What a stable cut leaves on the part: where its surface lies, and how the tip moves. README.md, "Surface".
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "base/progress.h"
#include "milling/cutting_force.h"
#include "milling/forced_vibration.h"
#include "milling/lobes.h"

namespace stablecut::milling {

struct SurfacePoint {
  /// Where the surface lies against the one wanted: of the walls that the cut leaves (at phi = 0 and 180
  /// degrees) and along the edge the largest in size, positive where material is left. None where no tooth
  /// touches a wall.
  std::optional<double> location_error_m;
  double peak_vibration_m = 0;  ///< largest distance of the tip from its mean
  double rms_vibration_m = 0;
  Eigen::Vector2d mean_deflection_m = Eigen::Vector2d::Zero();  ///< along the feed and normal to it
};

/// At one depth, the motion taken at `samples` turns of a period.
SurfacePoint surface_of(const ForcedVibration& vibration, const Cutter& cutter, double depth_m, int samples);

/// Whether the motion is one that ForcedVibration knows.
bool leaves_equal_chips(const Cutter& cutter, const CuttingLoad& load);

/// [depths][speeds]; nothing where the cut is unstable or the chart has no answer. The chart with its grid.
using SurfaceChart = std::vector<std::vector<std::optional<SurfacePoint>>>;
SurfaceChart surface_chart(const TipStructure& structure, const Cutter& cutter, const CuttingLoad& load,
                           const std::vector<double>& revolutions_per_s, const std::vector<double>& depths_m,
                           const StabilityChart& chart, int threads, const Progress& progress = {});

}  // namespace stablecut::milling
