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
constexpr int kMostPoints = 480;  // on the longest piece
// The same with unequal pitches: with several teeth in cut the error falls slowly there, and more points cost
// more than they give.
constexpr double kConvergedByTooth = 3e-7;
constexpr int kMostPointsByTooth = 60;
// An error from which on there is no answer.
constexpr double kUseless = 0.01;
// Points to begin with: so many, and so many for each radian that the fastest mode turns in half a piece.
constexpr double kFirstPoints = 6, kPointsPerRadian = 1.1;
// Points that a refinement adds: one for each kPointsForOne at hand, but at least kLeastAdded.
constexpr int kPointsForOne = 6, kLeastAdded = 3;
// Maps are compared at these shares of the largest depth. Depths with a radius above kFarAbove do not count;
// where all are, the depths are divided by kLowerBy, down to kLeastShare of the largest.
constexpr std::array<double, 4> kShares = {1, 0.5, 0.25, 1.0 / 16};
constexpr double kFarAbove = 100, kLowerBy = 64, kLeastShare = 1e-5;
// Below kNearRounding, kStagnation refinements in a row that do not divide the error by kGain: what is left
// is rounding.
constexpr double kNearRounding = 1e-5, kGain = 2;
constexpr int kStagnation = 3;
// Shares of the largest depth at which the semi-discretization is compared with the collocation.
constexpr std::array<double, 2> kSharesOfScheme = {1, 0.5};
// A product of frequency and period this far below a whole number is that number: a multiplier counts as real
// within 1e-7 of its size, 1.6e-8 of a wave.
constexpr double kWholeWave = 1e-6;

[[noreturn]] void fail_at(double revolutions_per_s, const std::string& what) {
  throw NoAnswer("at " + number_text(rpm_from_revolutions_per_s(revolutions_per_s)) + " rpm " + what +
                     ": raise the speed, lower the largest depth, or leave fast modes out",
                 Remedy::kModes);
}

// Points on the longest piece that should be near convergence. README.md, "How many points".
int first_guess(const TipStructure& structure, const Cutter& cutter, double revolutions_per_s,
                double largest_depth_m) {
  double longest = 0;
  for (const CutPiece& piece : cut_schedule(cutter, revolutions_per_s, largest_depth_m).pieces)
    longest = std::max(longest, piece.to_rad - piece.from_rad);
  const double half_turn =
      structure.lambda.imag().cwiseAbs().maxCoeff() * longest / (2 * kTwoPi * revolutions_per_s);
  const double points = kFirstPoints + kPointsPerRadian * half_turn;
  if (points > kMostPoints)
    fail_at(revolutions_per_s, "the fastest mode turns too often in one cut to be followed");
  return static_cast<int>(points);
}

// The largest difference of two maps' radii over a few depths, of max(1, radius). Depths far above the limit
// do not count, unless all are.
double largest_difference(const PeriodMap& map, const PeriodMap& finer, double largest_depth_m) {
  for (double top = largest_depth_m;; top /= kLowerBy) {
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
    const int finer_points = points + std::max(kLeastAdded, points / kPointsForOne);
    auto finer = build(finer_points);
    const double error = largest_difference(*map, *finer, largest_depth_m);
    without_gain = error < best.error / kGain || error > kNearRounding ? 0 : without_gain + 1;
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
  for (const double share : kSharesOfScheme) {
    const double depth = share * largest_depth_m;
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

int lobe_number(double chatter_frequency_hz, double tooth_period_s) {
  return static_cast<int>(std::floor(chatter_frequency_hz * tooth_period_s + kWholeWave));
}

namespace {

StabilityCrossing crossing_at(const StabilityBoundary& boundary, const PeriodMap& map,
                              double tooth_period_s) {
  const CriticalMultiplier critical = critical_multiplier(map, boundary.depth_m, boundary.multiplier);
  StabilityCrossing crossing;
  crossing.depth_m = boundary.depth_m;
  crossing.unstable_above = boundary.unstable_above;
  crossing.kind = critical.kind;
  crossing.chatter_frequency_hz = critical.chatter_frequency_hz;
  crossing.lobe = lobe_number(critical.chatter_frequency_hz, tooth_period_s);
  Eigen::Index mode = 0;
  crossing.participation = critical.participation.maxCoeff(&mode);
  crossing.mode = map.structure().source[mode];
  return crossing;
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
    const double tooth_period_s = cutter.tooth_period_s(revolutions_per_s[s]);
    for (const StabilityBoundary& boundary : scan.boundaries())
      chart.crossings[s].push_back(crossing_at(boundary, *period.map, tooth_period_s));
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
