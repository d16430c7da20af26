#include "milling/lobes.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <utility>

#include "base/error.h"
#include "base/parallel.h"
#include "milling/depth_scan.h"
#include "milling/period.h"
#include "milling/spectral.h"

namespace stablecut::milling {
namespace {

// Error of a grid's radii from which on more points are taken.
constexpr double kGridError = 4e-7;
// The same where modes are out of reach, whose ringing is left out.
constexpr double kGridErrorOutOfReach = 3e-4;
// The points are not more than so many times those of the limits: what is left is the interpolation.
constexpr double kMostGain = 1.5;

// The radii at one speed, whose limits are known; puts the error and the points that they needed into
// `limits`. Where radii lie far above 1 they need more points than the limits.
std::vector<double> grid_of(const TipStructure& structure, const Cutter& cutter, double revolutions_per_s,
                            const std::vector<double>& depths_m, SpeedLimits& limits) {
  const bool all_reached = wanted_change(structure, cutter, revolutions_per_s, depths_m.back()) < kGridError;
  const double wanted = all_reached ? kGridError : kGridErrorOutOfReach;
  const int most = most_points(cutter, limits.resolution);
  int points = more_points(limits.resolution);
  auto map = std::make_unique<SpectralMap>(structure, cutter, revolutions_per_s, points);
  for (;;) {
    const int finer_points = more_points(points);
    auto finer = std::make_unique<SpectralMap>(structure, cutter, revolutions_per_s, finer_points);
    const DepthScan scan(*map, depths_m.back());
    const double error = scan.error_against(*finer);
    if (error <= wanted || finer_points > most || points > kMostGain * limits.resolution) {
      limits.error = std::max(limits.error, error);
      return scan.spectral_radii(depths_m);
    }
    points = finer_points;
    map = std::move(finer);
  }
}

}  // namespace

StabilityChart stability_chart(const TipStructure& structure, const Cutter& cutter,
                               const std::vector<double>& revolutions_per_s,
                               const std::vector<double>& depths_m, const StabilityScheme& scheme,
                               bool with_grid, int threads, const Progress& progress) {
  const std::size_t speeds = revolutions_per_s.size();
  const Eigen::Index depths = depths_m.size();
  StabilityChart chart;
  if (with_grid) chart.spectral_radius.resize(depths, speeds);
  chart.crossings.resize(speeds);
  chart.error.resize(speeds);
  chart.resolution.resize(speeds);
  chart.failure.resize(speeds);

  const auto compute = [&](std::size_t s) {
    SpeedLimits limits;
    std::vector<double> radii;
    const bool straight = scheme.method == StabilityMethod::kSpectral && cutter.lag_rad_per_m == 0;
    if (straight && depths_m.back() > 0) {
      limits = speed_limits(structure, cutter, revolutions_per_s[s], depths_m.back());
      if (with_grid) radii = grid_of(structure, cutter, revolutions_per_s[s], depths_m, limits);
    } else {
      const PreparedPeriod period =
          prepare_period(structure, cutter, revolutions_per_s[s], scheme, depths_m.back());
      limits = {{}, period.error, period.resolution};
      if (depths_m.back() > 0) {
        limits.crossings =
            scanned_limits(period, depths_m.back(), cutter.tooth_period_s(revolutions_per_s[s])).crossings;
        if (with_grid) radii = DepthScan(*period.map, depths_m.back()).spectral_radii(depths_m);
      } else if (with_grid) {
        radii.assign(depths_m.size(), spectral_radius(*period.map, 0));
      }
    }
    if (with_grid) chart.spectral_radius.col(s) = Eigen::Map<const Eigen::VectorXd>(radii.data(), depths);
    chart.crossings[s] = std::move(limits.crossings);
    chart.error[s] = limits.error;
    chart.resolution[s] = limits.resolution;
  };
  const auto fail = [&](std::size_t s, const NoAnswer& error) {
    chart.failure[s] = error.what();
    chart.crossings[s].clear();
    chart.error[s] = 0;
    chart.resolution[s] = 0;
    if (with_grid) chart.spectral_radius.col(s).setConstant(std::numeric_limits<double>::quiet_NaN());
  };
  parallel_for(
      speeds, threads,
      [&](std::size_t s) {
        try {
          try {
            compute(s);
          } catch (const InvalidArgument& error) {
            fail_at(revolutions_per_s[s], error.what());
          }
        } catch (const NoAnswer& error) {
          fail(s, error);
        }
      },
      progress);
  if (std::none_of(chart.failure.begin(), chart.failure.end(),
                   [](const std::string& failure) { return failure.empty(); }))
    throw NoAnswer(chart.failure.front(), Remedy::kModes);
  return chart;
}

}  // namespace stablecut::milling
