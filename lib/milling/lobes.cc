#include "milling/lobes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/parallel.h"
#include "base/units.h"
#include "milling/semi_discretization.h"
#include "milling/spectral.h"

namespace stablecut {
namespace {

// Wanted change of the spectral radius when points are added, of max(1, radius). Far above the limit the
// radius is large and nobody needs its last digits.
constexpr double kConverged = 1e-8;
constexpr int kMostPoints = 240;        // per arc; then the error is what it is
constexpr double kNearLimit = 2;        // a radius from which the limit is near
constexpr double kMostHalfTurn = 1e4;   // rad in half an arc; more cannot be resolved by any number of points
constexpr int kStagnation = 3;          // refinements without improvement, once below
constexpr double kNearRounding = 1e-5;  // this: rounding is what is left
// Steps on the way to the largest depth: a share of the depth reached, between these parts of the largest.
constexpr double kRungShare = 0.06;
constexpr double kLeastRung = 1.0 / 512;
constexpr double kLargestRung = 1.0 / 64;
constexpr double kDepthTolerance = 1e-9;

// Enough points to be near convergence: a polynomial follows the fastest mode's turn over half an arc.
int first_guess(const TipStructure& structure, const Cutter& cutter, double revolutions_per_s) {
  double longest = 0;
  for (const EngagedArc& arc : engaged_arcs(cutter)) longest = std::max(longest, arc.to_rad - arc.from_rad);
  const double half_turn =
      structure.lambda.imag().cwiseAbs().maxCoeff() * longest / (2 * kTwoPi * revolutions_per_s);
  if (half_turn > kMostHalfTurn) {
    throw NoAnswer("at " + std::to_string(60 * revolutions_per_s) +
                   " rpm the fastest mode turns too often in one cut to be followed: leave it out with "
                   "--modes, or raise the speed");
  }
  return static_cast<int>(std::min(6 + 1.1 * half_turn, static_cast<double>(kMostPoints)));
}

PreparedPeriod converged_spectral(const TipStructure& structure, const Cutter& cutter,
                                  double revolutions_per_s, double largest_depth_m) {
  const auto build = [&](int points) {
    return std::make_unique<SpectralMap>(structure, cutter, revolutions_per_s, points);
  };
  int points = first_guess(structure, cutter, revolutions_per_s);
  auto map = build(points);
  // At the top, half way, and where the limit is near: far above it a radius may be astronomical.
  std::array<double, 3> depths = {largest_depth_m, largest_depth_m / 2, largest_depth_m / 4};
  for (int i = 0; i < 12 && spectral_radius(*map, depths[2]) > kNearLimit; ++i) depths[2] /= 2;
  const auto radii = [&](const PeriodMap& at) {
    std::array<double, 3> radius{};
    std::transform(depths.begin(), depths.end(), radius.begin(),
                   [&](double d) { return spectral_radius(at, d); });
    return radius;
  };
  auto radius = radii(*map);
  PreparedPeriod best;
  best.error = std::numeric_limits<double>::infinity();
  for (int without_gain = 0;;) {
    const int finer_points = points + std::max(3, points / 6);
    auto finer = build(finer_points);
    const auto finer_radius = radii(*finer);
    double error = 0;
    for (std::size_t i = 0; i < radius.size(); ++i) {
      error = std::max(error, std::abs(finer_radius[i] - radius[i]) / std::max(1.0, finer_radius[i]));
    }
    without_gain = error < best.error / 2 || error > kNearRounding ? 0 : without_gain + 1;
    if (error < best.error) best = {std::move(map), error, points};
    if (error <= kConverged || finer_points > kMostPoints || without_gain == kStagnation) return best;
    points = finer_points;
    map = std::move(finer);
    radius = finer_radius;
  }
}

// Where rho - 1 changes sign between a stable and an unstable depth: bisection with secant steps (Illinois).
double refine_crossing(const PeriodMap& map, double stable, double stable_excess, double unstable,
                       double unstable_excess, double tolerance) {
  int last_side = 0;
  for (int iteration = 0; iteration < 100 && unstable - stable > tolerance; ++iteration) {
    double middle = (stable * unstable_excess - unstable * stable_excess) / (unstable_excess - stable_excess);
    if (iteration % 4 == 3 || !(middle > stable && middle < unstable)) middle = (stable + unstable) / 2;
    const double excess = spectral_radius(map, middle) - 1;
    if (excess > 0) {
      unstable = middle;
      unstable_excess = excess;
      if (last_side == 1) stable_excess /= 2;
      last_side = 1;
    } else {
      stable = middle;
      stable_excess = excess;
      if (last_side == -1) unstable_excess /= 2;
      last_side = -1;
    }
  }
  return unstable;
}

struct Rung {
  double depth_m;
  double excess;  // rho - 1
};

// The highest point of a hump between two rungs (golden section), or the first found above 1.
Rung climb(const PeriodMap& map, double from, double to) {
  constexpr double kGolden = 0.6180339887498949;
  double a = from, b = to;
  Rung left{b - kGolden * (b - a), 0}, right{a + kGolden * (b - a), 0};
  left.excess = spectral_radius(map, left.depth_m) - 1;
  right.excess = spectral_radius(map, right.depth_m) - 1;
  for (int iteration = 0; iteration < 24 && left.excess <= 0 && right.excess <= 0; ++iteration) {
    if (left.excess > right.excess) {
      b = right.depth_m;
      right = left;
      left.depth_m = b - kGolden * (b - a);
      left.excess = spectral_radius(map, left.depth_m) - 1;
    } else {
      a = left.depth_m;
      left = right;
      right.depth_m = a + kGolden * (b - a);
      right.excess = spectral_radius(map, right.depth_m) - 1;
    }
  }
  return left.excess > 0 ? left : right;
}

}  // namespace

PreparedPeriod prepare_period(const TipStructure& structure, const Cutter& cutter, double revolutions_per_s,
                              const StabilityScheme& scheme, double largest_depth_m) {
  PreparedPeriod spectral = converged_spectral(structure, cutter, revolutions_per_s, largest_depth_m);
  if (scheme.method == StabilityMethod::kSpectral) return spectral;
  auto map = std::make_unique<SemiDiscretizationMap>(structure, cutter, revolutions_per_s, scheme.intervals);
  double error = 0;
  for (const double depth : {largest_depth_m, largest_depth_m / 2}) {
    const double exact = spectral_radius(*spectral.map, depth);
    error = std::max(error, std::abs(spectral_radius(*map, depth) - exact) / std::max(1.0, exact));
  }
  return {std::move(map), error, scheme.intervals};
}

std::optional<StabilityLimit> lowest_limit(const PeriodMap& map, double largest_depth_m,
                                           const std::vector<double>& known_depths_m,
                                           const Eigen::VectorXd& known_radii) {
  if (!(largest_depth_m > 0)) return std::nullopt;
  const double tolerance = kDepthTolerance * largest_depth_m;
  const auto limit_between = [&](const Rung& stable, const Rung& unstable) {
    const double depth =
        refine_crossing(map, stable.depth_m, stable.excess, unstable.depth_m, unstable.excess, tolerance);
    return StabilityLimit{depth, critical_multiplier(map, depth)};
  };

  std::vector<Rung> ladder = {{0, spectral_radius(map, 0) - 1}};
  std::size_t known = 0;
  while (ladder.back().depth_m < largest_depth_m) {
    while (known < known_depths_m.size() && known_depths_m[known] <= ladder.back().depth_m) ++known;
    const double step = std::clamp(kRungShare * ladder.back().depth_m, kLeastRung * largest_depth_m,
                                   kLargestRung * largest_depth_m);
    double depth = std::min(ladder.back().depth_m + step, largest_depth_m);
    double excess = 0;
    if (known < known_depths_m.size() && known_depths_m[known] <= depth * (1 + 1e-12)) {
      depth = known_depths_m[known];
      excess = known_radii[static_cast<Eigen::Index>(known)] - 1;
    } else {
      excess = spectral_radius(map, depth) - 1;
    }
    ladder.push_back({depth, excess});

    if (ladder.size() >= 3) {
      const Rung& before = ladder[ladder.size() - 3];
      const Rung& top = ladder[ladder.size() - 2];
      const Rung& after = ladder.back();
      const double rise = std::max(top.excess - before.excess, top.excess - after.excess);
      if (top.excess >= before.excess && top.excess >= after.excess && top.excess + rise > 0) {
        const Rung summit = climb(map, before.depth_m, after.depth_m);
        if (summit.excess > 0) return limit_between(before, summit);
      }
    }
    if (ladder.back().excess > 0) return limit_between(ladder[ladder.size() - 2], ladder.back());
  }
  return std::nullopt;
}

StabilityChart stability_chart(const TipStructure& structure, const Cutter& cutter,
                               const std::vector<double>& revolutions_per_s,
                               const std::vector<double>& depths_m, const StabilityScheme& scheme,
                               bool with_grid, int threads, const Progress& progress) {
  const std::size_t speeds = revolutions_per_s.size();
  const auto depths = static_cast<Eigen::Index>(depths_m.size());
  StabilityChart chart;
  if (with_grid) chart.spectral_radius.resize(depths, static_cast<Eigen::Index>(speeds));
  chart.limit.resize(speeds);
  std::vector<double> error(speeds, 0.0);
  std::vector<int> resolution(speeds, 0);

  parallel_for(
      speeds, threads,
      [&](std::size_t s) {
        const PreparedPeriod period =
            prepare_period(structure, cutter, revolutions_per_s[s], scheme, depths_m.back());
        error[s] = period.error;
        resolution[s] = period.resolution;
        Eigen::VectorXd radii(with_grid ? depths : 0);
        for (Eigen::Index i = 0; i < radii.size(); ++i) {
          radii[i] = spectral_radius(*period.map, depths_m[static_cast<std::size_t>(i)]);
        }
        if (with_grid) chart.spectral_radius.col(static_cast<Eigen::Index>(s)) = radii;
        chart.limit[s] =
            lowest_limit(*period.map, depths_m.back(), with_grid ? depths_m : std::vector<double>{}, radii);
      },
      progress);

  if (speeds > 0) {
    chart.error = *std::max_element(error.begin(), error.end());
    chart.least_resolution = *std::min_element(resolution.begin(), resolution.end());
    chart.largest_resolution = *std::max_element(resolution.begin(), resolution.end());
  }
  return chart;
}

}  // namespace stablecut
