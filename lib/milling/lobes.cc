#include "milling/lobes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "base/error.h"
#include "base/number_text.h"
#include "base/parallel.h"
#include "base/units.h"
#include "milling/depth_scan.h"
#include "milling/semi_discretization.h"
#include "milling/spectral.h"

namespace stablecut::milling {
namespace {

// Wanted change of the spectral radius when points are added, of max(1, radius). Far above the limit the
// radius is large and nobody needs its last digits.
constexpr double kConverged = 1e-8;
constexpr int kMostPoints = 480;  // on a piece; then the error is what it is
// With unequal pitches and several teeth in cut the error falls slowly; more points cost more than they give.
constexpr double kConvergedByTooth = 3e-7;
constexpr int kMostPointsByTooth = 60;
// From this error on there is no answer.
constexpr double kUseless = 0.01;
// A radius from which on nobody needs its digits.
constexpr double kFarAbove = 100;
constexpr double kLeastShare = 1e-5;    // of the largest depth that is looked at
constexpr int kStagnation = 3;          // refinements without improvement, once below
constexpr double kNearRounding = 1e-5;  // this: rounding is what is left
[[noreturn]] void fail_at(double revolutions_per_s, const std::string& what) {
  throw NoAnswer("at " + number_text(60 * revolutions_per_s) + " rpm " + what +
                 ": leave fast modes out with --modes, raise the speed, or lower the largest depth");
}

// Enough points to be near convergence: a polynomial follows the fastest mode's turn over half a piece.
int first_guess(const TipStructure& structure, const Cutter& cutter, double revolutions_per_s,
                double largest_depth_m) {
  double longest = 0;
  for (const CutPiece& piece : cut_schedule(cutter, revolutions_per_s, largest_depth_m).pieces)
    longest = std::max(longest, piece.to_rad - piece.from_rad);
  const double half_turn =
      structure.lambda.imag().cwiseAbs().maxCoeff() * longest / (2 * kTwoPi * revolutions_per_s);
  const double points = 6 + 1.1 * half_turn;
  if (points > kMostPoints)
    fail_at(revolutions_per_s, "the fastest mode turns too often in one cut to be followed");
  return static_cast<int>(points);
}

// The largest difference of two maps' radii over a few depths, of max(1, radius). Depths far above the limit
// do not count, unless all are.
double largest_difference(const PeriodMap& map, const PeriodMap& finer, double largest_depth_m) {
  constexpr std::array<double, 4> kShares = {1, 0.5, 0.25, 1.0 / 16};
  for (double top = largest_depth_m;; top /= 64) {
    std::vector<Eigen::MatrixXd> monodromy;
    for (const PeriodMap* of : {&map, &finer}) {
      for (const double share : kShares) monodromy.push_back(of->monodromy(share * top));
    }
    const auto multipliers = leading_multipliers(std::move(monodromy), 2 * map.structure().modes());
    double error = -1;
    for (std::size_t i = 0; i < kShares.size(); ++i) {
      const double radius = multipliers[i].cwiseAbs().maxCoeff();
      const double better = multipliers[kShares.size() + i].cwiseAbs().maxCoeff();
      if (better <= kFarAbove || top < kLeastShare * largest_depth_m)
        error = std::max(error, std::abs(radius - better) / std::max(1.0, better));
    }
    if (error >= 0) return error;
  }
}

PreparedPeriod converged_spectral(const TipStructure& structure, const Cutter& cutter,
                                  double revolutions_per_s, double largest_depth_m) {
  const auto build = [&](int points) {
    return std::make_unique<SpectralMap>(structure, cutter, revolutions_per_s, points);
  };
  const bool by_tooth = !cutter.equal_pitch();
  const double converged = by_tooth ? kConvergedByTooth : kConverged;
  int points = first_guess(structure, cutter, revolutions_per_s, largest_depth_m);
  const int most = by_tooth ? std::max(points, kMostPointsByTooth) : kMostPoints;
  auto map = build(points);
  PreparedPeriod best;
  best.error = std::numeric_limits<double>::infinity();
  for (int without_gain = 0;;) {
    const int finer_points = points + std::max(3, points / 6);
    auto finer = build(finer_points);
    const double error = largest_difference(*map, *finer, largest_depth_m);
    without_gain = error < best.error / 2 || error > kNearRounding ? 0 : without_gain + 1;
    if (error < best.error) best = {std::move(map), error, points};
    if (error <= converged || finer_points > most || without_gain == kStagnation) break;
    points = finer_points;
    map = std::move(finer);
  }
  if (!(best.error < kUseless)) fail_at(revolutions_per_s, "the spectral radius does not converge");
  return best;
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

const StabilityCrossing* limit_of(const std::vector<StabilityCrossing>& crossings) {
  const auto lowest = std::find_if(crossings.begin(), crossings.end(),
                                   [](const StabilityCrossing& c) { return c.unstable_above; });
  return lowest == crossings.end() ? nullptr : &*lowest;
}

std::optional<double> limit_depth(const TipStructure& structure, const Cutter& cutter,
                                  double revolutions_per_s, StabilityMethod method, int resolution,
                                  double largest_depth_m) {
  std::unique_ptr<PeriodMap> map;
  if (method == StabilityMethod::kSpectral)
    map = std::make_unique<SpectralMap>(structure, cutter, revolutions_per_s, resolution);
  else
    map = std::make_unique<SemiDiscretizationMap>(structure, cutter, revolutions_per_s, resolution);
  const auto boundaries = DepthScan(*map, largest_depth_m, DepthScan::kForLimits).boundaries();
  return boundaries.empty() ? std::nullopt : std::optional(boundaries.front().depth_m);
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

  const auto compute = [&](std::size_t s) {
    const PreparedPeriod period =
        prepare_period(structure, cutter, revolutions_per_s[s], scheme, depths_m.back());
    chart.error[s] = period.error;
    chart.resolution[s] = period.resolution;
    if (depths_m.back() == 0) {
      if (with_grid) chart.spectral_radius.col(s).setConstant(spectral_radius(*period.map, 0));
      return;
    }
    const DepthScan scan(*period.map, depths_m.back());
    if (with_grid) {
      const std::vector<double> radii = scan.spectral_radii(depths_m);
      chart.spectral_radius.col(s) = Eigen::Map<const Eigen::VectorXd>(radii.data(), depths);
    }
    for (const StabilityBoundary& boundary : scan.boundaries()) {
      const CriticalMultiplier critical =
          critical_multiplier(*period.map, boundary.depth_m, boundary.multiplier);
      StabilityCrossing crossing{
          boundary.depth_m, boundary.unstable_above, critical.kind, critical.chatter_frequency_hz, 0, 0, 0};
      crossing.lobe =
          static_cast<int>(critical.chatter_frequency_hz * cutter.tooth_period_s(revolutions_per_s[s]));
      Eigen::Index mode = 0;
      crossing.participation = critical.participation.maxCoeff(&mode);
      crossing.mode = structure.source[mode];
      chart.crossings[s].push_back(crossing);
    }
  };
  parallel_for(
      speeds, threads,
      [&](std::size_t s) {
        try {
          compute(s);
        } catch (const InvalidArgument& error) {
          fail_at(revolutions_per_s[s], error.what());
        }
      },
      progress);
  return chart;
}

}  // namespace stablecut::milling
