#include "milling/lobes.h"

#include <algorithm>
#include <cmath>
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

// One speed of a chart.
struct Column {
  SpeedLimits limits;
  std::vector<double> radii;  // empty without a grid
};

// Leaves out, as NaN, the radii that are no nearer to the truth than to 1, where `limits` that are known by
// other means do not say the same: on which side of 1 they lie is not known.
void leave_doubtful_out(const std::vector<double>& depths_m, double error,
                        const std::vector<StabilityCrossing>* limits, std::vector<double>& radii) {
  if (error < kUseless) return;
  for (std::size_t d = 0; d < radii.size(); ++d) {
    const bool agrees = limits != nullptr && stable_between(*limits, depths_m[d]) == (radii[d] < 1);
    if (std::abs(std::min(radii[d], kFarAbove) - 1) <= error && !agrees)
      radii[d] = std::numeric_limits<double>::quiet_NaN();
  }
}

// The radii at a speed whose limits are known; raises the error to that of the radii. Far above 1 they need
// more points than the limits.
std::vector<double> grid_of(const TipStructure& structure, const Cutter& cutter, double revolutions_per_s,
                            const std::vector<double>& depths_m, SpeedLimits& limits) {
  if (!cutter.equal_pitch() || cutter.changes_with_depth()) {
    // The limits' polynomials say nothing about the points of a map, or maps are dear.
    const PreparedPeriod period = prepare_period(structure, cutter, revolutions_per_s, {}, depths_m.back());
    const DepthScan scan(*period.map, depths_m.back());
    limits.error = std::max({limits.error, period.error, scan.error_against(*period.map)});
    return scan.spectral_radii(depths_m);
  }
  const PointPlan plan = point_plan(structure, cutter, revolutions_per_s, depths_m.back());
  const double wanted = plan.follows_all ? kGridError : kGridErrorOutOfReach;
  int points = more_points(limits.resolution);
  auto map = std::make_unique<SpectralMap>(structure, cutter, revolutions_per_s, points);
  for (;;) {
    const int finer_points = more_points(points);
    auto finer = std::make_unique<SpectralMap>(structure, cutter, revolutions_per_s, finer_points);
    const DepthScan scan(*map, depths_m.back());
    const double error = scan.error_against(*finer);
    if (error <= wanted || finer_points > plan.most || points > kMostGain * limits.resolution) {
      limits.error = std::max(limits.error, error);
      return scan.spectral_radii(depths_m);
    }
    points = finer_points;
    map = std::move(finer);
  }
}

Column column_of(const TipStructure& structure, const Cutter& cutter, double revolutions_per_s,
                 const std::vector<double>& depths_m, const StabilityScheme& scheme, bool with_grid) {
  const double top = depths_m.back();
  if (scheme.method == StabilityMethod::kSpectral && top > 0) {
    if (const auto limits = circle_limits(structure, cutter, revolutions_per_s, top)) {
      Column column{*limits, {}};
      if (with_grid) {
        column.radii = grid_of(structure, cutter, revolutions_per_s, depths_m, column.limits);
        leave_doubtful_out(depths_m, column.limits.error, &column.limits.crossings, column.radii);
      }
      return column;
    }
  }
  const PreparedPeriod period = prepare_period(structure, cutter, revolutions_per_s, scheme, top);
  Column column{{{}, period.error, period.resolution}, {}};
  if (top == 0) {
    if (with_grid) column.radii.assign(depths_m.size(), spectral_radius(*period.map, 0));
    return column;
  }
  const DepthScan scan(*period.map, top, with_grid ? DepthScan::kExact : DepthScan::kForLimits);
  column.limits.crossings = scanned_crossings(scan, *period.map, cutter.tooth_period_s(revolutions_per_s));
  if (with_grid) {
    column.radii = scan.spectral_radii(depths_m);
    column.limits.error = std::max(period.error, scan.error_against(*period.map));
    if (scheme.method == StabilityMethod::kSpectral)
      leave_doubtful_out(depths_m, column.limits.error, nullptr, column.radii);
  }
  return column;
}

}  // namespace

std::size_t StabilityChart::doubtful() const {
  std::size_t count = 0;
  for (Eigen::Index s = 0; s < spectral_radius.cols(); ++s) {
    if (failure[static_cast<std::size_t>(s)].empty())
      count += static_cast<std::size_t>(spectral_radius.col(s).array().isNaN().count());
  }
  return count;
}

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
    Column column = column_of(structure, cutter, revolutions_per_s[s], depths_m, scheme, with_grid);
    if (with_grid)
      chart.spectral_radius.col(s) = Eigen::Map<const Eigen::VectorXd>(column.radii.data(), depths);
    chart.crossings[s] = std::move(column.limits.crossings);
    chart.error[s] = column.limits.error;
    chart.resolution[s] = column.limits.resolution;
  };
  const auto fail = [&](std::size_t s, const NoAnswer& error) {
    chart.failure[s] = error.what();
    if (with_grid) chart.spectral_radius.col(s).setConstant(std::numeric_limits<double>::quiet_NaN());
  };
  parallel_for(
      speeds, threads,
      [&](std::size_t s) {
        try {
          compute(s);
        } catch (const NoAnswer& error) {
          fail(s, error);
        } catch (const InvalidArgument& error) {
          fail(s, no_answer_at(revolutions_per_s[s], error.what()));
        }
      },
      progress);
  if (std::none_of(chart.failure.begin(), chart.failure.end(),
                   [](const std::string& failure) { return failure.empty(); }))
    throw NoAnswer(chart.failure.front(), Remedy::kModes);
  return chart;
}

}  // namespace stablecut::milling
