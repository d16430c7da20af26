#include "milling/surface.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "base/units.h"

namespace stablecut::milling {
namespace {

constexpr double kSamplesPerWave = 12;  // of the fastest mode, and of twice the spindle's turn
constexpr int kLeastSamples = 48, kMostSamples = 4096;
constexpr double kAtWall = 1e-9;  // rad

int samples_of(const TipStructure& structure, double revolutions_per_s, double period_rad) {
  const double fastest =
      structure.modes() > 0 ? structure.lambda.imag().maxCoeff() / (kTwoPi * revolutions_per_s) : 0;
  const double waves = std::max(fastest, 2.0) * period_rad / kTwoPi;
  return static_cast<int>(
      std::clamp(std::ceil(kSamplesPerWave * waves), double{kLeastSamples}, double{kMostSamples}));
}

// The largest of some values at equal distances over a period, by the parabola through the largest and its
// neighbours.
double summit(const Eigen::VectorXd& values) {
  Eigen::Index top = 0;
  values.maxCoeff(&top);
  const Eigen::Index n = values.size();
  const double before = values[(top + n - 1) % n], at = values[top], after = values[(top + 1) % n];
  const double bend = 2 * at - before - after;
  return bend > 0 ? at + (after - before) * (after - before) / (8 * bend) : at;
}

// The walls that a cut leaves: the angle of a tooth that touches one.
std::vector<double> walls_of(const Cutter& cutter) {
  std::vector<double> walls;
  if (cutter.entry_rad < kAtWall) walls.push_back(0);
  if (cutter.exit_rad > kPi - kAtWall) walls.push_back(kPi);
  return walls;
}

SurfacePoint scaled(SurfacePoint point, double depth_m) {
  if (point.location_error_m) *point.location_error_m *= depth_m;
  point.peak_vibration_m *= depth_m;
  point.rms_vibration_m *= depth_m;
  point.mean_deflection_m *= depth_m;
  return point;
}

}  // namespace

SurfacePoint surface_of(const ForcedVibration& vibration, const Cutter& cutter, double depth_m, int samples) {
  SurfacePoint result;
  result.mean_deflection_m = vibration.mean(depth_m);
  const Eigen::Matrix2Xd motion =
      vibration.displacements(depth_m, samples).colwise() - result.mean_deflection_m;
  result.peak_vibration_m = std::sqrt(summit(motion.colwise().squaredNorm()));
  result.rms_vibration_m = std::sqrt(motion.colwise().squaredNorm().mean());
  const double lag = cutter.lag_rad_per_m * depth_m;
  const int heights = 1 + static_cast<int>(std::ceil(samples * std::abs(lag) / vibration.period_rad()));
  for (const double wall : walls_of(cutter)) {
    for (int i = 0; i < (lag == 0 ? 1 : heights + 1); ++i) {
      // The edge at a height passes the wall after its tip. A tip that stands nearer to the wall cuts deeper.
      const Eigen::Vector2d tip = vibration.displacement(depth_m, wall + lag * i / heights);
      const double error = wall == 0 ? -tip.y() : tip.y();
      if (!result.location_error_m || std::abs(error) > std::abs(*result.location_error_m))
        result.location_error_m = error;
    }
  }
  return result;
}

bool leaves_equal_chips(const Cutter& cutter, const CuttingLoad& load) {
  return cutter.equal_pitch() && load.runout_m.empty() && cutter.damping_n_per_m == 0;
}

SurfaceChart surface_chart(const TipStructure& structure, const Cutter& cutter, const CuttingLoad& load,
                           const std::vector<double>& revolutions_per_s, const std::vector<double>& depths_m,
                           const StabilityChart& chart, int threads, const Progress& progress) {
  const ForceCycle force = force_cycle(cutter, load);
  SurfaceChart result(depths_m.size(), {revolutions_per_s.size(), std::nullopt});
  parallel_for(
      revolutions_per_s.size(), threads,
      [&](std::size_t s) {
        const ForcedVibration vibration(structure, cutter, force, revolutions_per_s[s]);
        const int samples = samples_of(structure, revolutions_per_s[s], force.period_rad);
        // The motion under straight teeth is in proportion to the depth.
        std::optional<SurfacePoint> per_depth;
        if (cutter.lag_rad_per_m == 0) per_depth = surface_of(vibration, cutter, 1, samples);
        for (std::size_t d = 0; d < depths_m.size(); ++d) {
          if (!(chart.spectral_radius(d, s) < 1)) continue;
          result[d][s] = per_depth ? scaled(*per_depth, depths_m[d])
                                   : surface_of(vibration, cutter, depths_m[d], samples);
        }
      },
      progress);
  return result;
}

}  // namespace stablecut::milling
