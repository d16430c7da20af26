#include "milling/period.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "base/error.h"
#include "base/number_text.h"
#include "base/units.h"
#include "milling/cut_schedule.h"
#include "milling/depth_scan.h"
#include "milling/semi_discretization.h"
#include "milling/spectral.h"

namespace stablecut::milling {
namespace {

// Wanted change of the spectral radius when points are added, of max(1, radius). Far above the limit the
// radius is large and nobody needs its last digits.
constexpr double kConverged = 1e-8;
constexpr int kMostPoints = 200;  // on the longest piece
// The same with unequal pitches: with several teeth in cut the error falls slowly there, and more points cost
// more than they give.
constexpr double kConvergedByTooth = 3e-7;
// The same where modes are out of reach: their ringing after each entry is left out.
constexpr double kConvergedOutOfReach = 1e-5;
constexpr int kMostPointsByTooth = 60;
// The same where helices differ: the error of the discs falls with the square of their number.
constexpr double kConvergedByDisc = 1e-4;
constexpr int kMostPointsByDisc = 24;
// More where other teeth enter or leave while one cuts, at places that are no ends of its arc.
constexpr double kMoreTogether = 2;
// Points to begin with: so many, and so many for each radian that the fastest mode turns in half a piece.
constexpr double kFirstPoints = 7, kPointsPerRadian = 1.1;
// A mode is out of reach that limits by itself only above so many times the largest depth.
constexpr double kReached = 1.1;
// Modes up to so many times the highest one in reach are not stand-ins.
constexpr double kStandIn = 3;
// Radians in half a piece up to which every mode is followed.
constexpr double kManyRadians = 24;
// Points that a refinement adds: one for each kPointsForOne at hand, but at least kLeastAdded.
constexpr int kPointsForOne = 6, kLeastAdded = 3;
// Maps are compared at these shares of the largest depth. Depths with a radius above kFarAbove do not count;
// where all are, the depths are divided by kLowerBy, down to kLeastShare of the largest.
constexpr std::array<double, 4> kShares = {1, 0.5, 0.25, 1.0 / 16};
constexpr double kLowerBy = 64, kLeastShare = 1e-5;
// Below kNearRounding, kStagnation refinements in a row that do not divide the error by kGain: what is left
// is rounding.
constexpr double kNearRounding = 1e-5, kGain = 2;
constexpr int kStagnation = 3;
// Shares of the largest depth at which the semi-discretization is compared with the collocation.
constexpr std::array<double, 2> kSharesOfScheme = {1, 0.5};

// The largest difference of two maps' radii over a few depths, by radius_error(). Where all lie far above the
// limit, lower depths are looked at too.
double largest_difference(const PeriodMap& map, const PeriodMap& finer, double largest_depth_m) {
  double error = 0;
  for (double top = largest_depth_m;; top /= kLowerBy) {
    std::vector<Eigen::MatrixXd> monodromy;
    for (const PeriodMap* of : {&map, &finer}) {
      for (const double share : kShares) monodromy.push_back(of->monodromy(share * top));
    }
    const auto multipliers = leading_multipliers(std::move(monodromy), 2 * map.structure().modes());
    bool enough = top < kLeastShare * largest_depth_m;
    for (std::size_t i = 0; i < kShares.size(); ++i) {
      const double radius = multipliers[i].cwiseAbs().maxCoeff();
      const double better = multipliers[kShares.size() + i].cwiseAbs().maxCoeff();
      error = std::max(error, radius_error(radius, better));
      enough = enough || better <= kFarAbove;
    }
    if (enough) return error;
  }
}

PreparedPeriod converged_spectral(const TipStructure& structure, const Cutter& cutter,
                                  double revolutions_per_s, double largest_depth_m) {
  const auto build = [&](int points) {
    return std::make_unique<SpectralMap>(structure, cutter, revolutions_per_s, points);
  };
  const PointPlan plan = point_plan(structure, cutter, revolutions_per_s, largest_depth_m);
  int points = plan.first;
  auto map = build(points);
  PreparedPeriod best;
  best.error = std::numeric_limits<double>::infinity();
  for (int without_gain = 0;;) {
    const int finer_points = more_points(points);
    auto finer = build(finer_points);
    const double error = largest_difference(*map, *finer, largest_depth_m);
    without_gain = error < best.error / kGain || error > kNearRounding ? 0 : without_gain + 1;
    if (error < best.error) best = {std::move(map), error, points};
    if (error <= plan.wanted || finer_points > plan.most || without_gain == kStagnation) break;
    points = finer_points;
    map = std::move(finer);
  }
  refuse_useless(revolutions_per_s, best.error);
  return best;
}

// The highest frequency (rad/s) that polynomials must follow. Modes that turn often in a cut feel the mean A
// of the directional matrix: 1 / depth = (1 - 1 / mu) c / (s - lambda), c = psi_L^T A psi_R, which is real no
// lower than where depth (|c| + Re c) is the distance of the pole from the axis [Altintas1995]. Where the
// fastest mode that is reached lies far below the fastest of all, what is above are stand-ins for what lies
// above the band, and only their compliance matters.
double followed(const TipStructure& structure, const Cutter& cutter, const CutSchedule& schedule,
                double revolutions_per_s, double largest_depth_m) {
  const double fastest = structure.lambda.imag().cwiseAbs().maxCoeff();
  // Where all of them are cheap to follow, nothing is left out.
  if (half_turn_of(fastest, schedule, revolutions_per_s) <= kManyRadians) return fastest;
  const Eigen::Matrix3d whole =
      mean_directional_coefficients(cutter, 0, cutter.mean_pitch_rad(), largest_depth_m);
  const Eigen::MatrixXd mean = whole(structure.axes, structure.axes);
  double highest = 0;
  for (Eigen::Index k = 0; k < structure.modes(); ++k) {
    const std::complex<double> c =
        (structure.psi_l.col(k).transpose() * mean * structure.psi_r.col(k)).value();
    if (kReached * largest_depth_m * (std::abs(c) + c.real()) >= -structure.lambda[k].real())
      highest = std::max(highest, std::abs(structure.lambda[k].imag()));
  }
  // Modes a little above it are followed too.
  double next = 0;
  for (const std::complex<double>& lambda : structure.lambda) {
    if (std::abs(lambda.imag()) <= kStandIn * highest) next = std::max(next, std::abs(lambda.imag()));
  }
  return next > 0 ? next : fastest;
}

}  // namespace

NoAnswer no_answer_at(double revolutions_per_s, const std::string& what) {
  return NoAnswer("at " + number_text(rpm_from_revolutions_per_s(revolutions_per_s)) + " rpm " + what +
                      ": raise the speed, lower the largest depth, or leave fast modes out",
                  Remedy::kModes);
}

PointPlan point_plan(const TipStructure& structure, const Cutter& cutter, double revolutions_per_s,
                     double largest_depth_m) {
  const CutSchedule schedule = cut_schedule(cutter, revolutions_per_s, largest_depth_m);
  const double fastest = structure.lambda.imag().cwiseAbs().maxCoeff();
  const double nodes = kPointsPerRadian * half_turn_of(fastest, schedule, revolutions_per_s);
  if (nodes > kMostPoints)
    throw no_answer_at(revolutions_per_s, "the fastest mode turns too often in one cut to be followed");
  const auto by_node = static_cast<int>(kFirstPoints + nodes);
  if (cutter.helices_differ()) return {by_node, std::max(by_node, kMostPointsByDisc), kConvergedByDisc};
  if (!cutter.equal_pitch()) return {by_node, std::max(by_node, kMostPointsByTooth), kConvergedByTooth};
  if (cutter.changes_with_depth()) return {by_node, kMostPoints, kConverged};
  const double follow = followed(structure, cutter, schedule, revolutions_per_s, largest_depth_m);
  const bool all = follow >= fastest;
  return {static_cast<int>(kFirstPoints + half_turn_of(follow, schedule, revolutions_per_s)), kMostPoints,
          all ? kConverged : kConvergedOutOfReach, all};
}

PointPlan plan_by_tooth(const TipStructure& structure, const Cutter& cutter, double revolutions_per_s) {
  const CutSchedule arcs = tooth_arcs(cutter, revolutions_per_s);
  const double fastest = structure.lambda.imag().cwiseAbs().maxCoeff();
  const bool together = cutter.exit_rad - cutter.entry_rad >
                        *std::min_element(cutter.pitch_rad.begin(), cutter.pitch_rad.end());
  const double first = kFirstPoints + (together ? kMoreTogether : 0);
  return {static_cast<int>(first + half_turn_of(fastest, arcs, revolutions_per_s)), kMostPoints,
          kConvergedByTooth};
}

int more_points(int points) { return points + std::max(kLeastAdded, points / kPointsForOne); }

void refuse_useless(double revolutions_per_s, double error) {
  if (!(error < kUseless)) throw no_answer_at(revolutions_per_s, "the spectral radius does not converge");
}

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

}  // namespace stablecut::milling
