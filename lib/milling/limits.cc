#include "milling/limits.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/error.h"
#include "base/units.h"
#include "milling/circle_scan.h"
#include "milling/cut_schedule.h"
#include "milling/helical_limits.h"
#include "milling/semi_discretization.h"
#include "milling/spectral.h"
#include "milling/tooth_arcs.h"

namespace stablecut::milling {
namespace {

// A product of frequency and period this far below a whole number is that number: a multiplier counts as real
// within 1e-7 of its size, 1.6e-8 of a wave.
constexpr double kWholeWave = 1e-6;

// Operators of more rows than kManyRows, and of more than kLongCut times the structure's state, are left to
// the depth scan, whose leading eigenvalues cost less there.
constexpr Eigen::Index kManyRows = 96, kLongCut = 2;
// The same for unequal pitches, where the scan has many times their rows.
constexpr Eigen::Index kManyRowsByTooth = 160;
// Order in which the error of polynomials along an arc falls where other teeth enter or leave meanwhile, and
// the largest step that is taken by it.
constexpr double kOrderByTooth = 7, kLargestGrowth = 1.5;
// Rounds in which passages close together may be in doubt.
constexpr int kMostDoubts = 5;

StabilityCrossing crossing_of(double depth_m, bool unstable_above, const Chatter& chatter,
                              const TipStructure& structure, double tooth_period_s) {
  StabilityCrossing crossing;
  crossing.depth_m = depth_m;
  crossing.unstable_above = unstable_above;
  crossing.kind = chatter.kind;
  crossing.chatter_frequency_hz = chatter.frequency_hz;
  crossing.lobe = lobe_number(chatter.frequency_hz, tooth_period_s);
  Eigen::Index mode = 0;
  crossing.participation = chatter.participation.maxCoeff(&mode);
  crossing.mode = structure.source[mode];
  return crossing;
}

// A cut whose teeth are where they are at every depth.
class StraightCut {
 public:
  StraightCut(const TipStructure& structure, const Cutter& cutter, double revolutions_per_s)
      : structure_(structure),
        revolutions_per_s_(revolutions_per_s),
        tooth_period_s_(cutter.tooth_period_s(revolutions_per_s)),
        by_tooth_(!cutter.equal_pitch()),
        schedule_(by_tooth_ ? tooth_arcs(cutter, revolutions_per_s)
                            : cut_schedule(cutter, revolutions_per_s, 0)),
        period_s_(schedule_.period_rad / (kTwoPi * revolutions_per_s)) {}

  PeriodForce force(int polynomials) const {
    if (by_tooth_) return tooth_arc_force(structure_, schedule_, revolutions_per_s_, polynomials);
    return period_force(structure_, collocate(structure_, schedule_, revolutions_per_s_, polynomials),
                        period_s_);
  }
  bool suits_the_circle(const PeriodForce& force) const {
    if (by_tooth_) return force.whole.size() <= kManyRowsByTooth;
    return force.whole.size() <= std::max(kManyRows, kLongCut * 2 * structure_.modes());
  }

  // Polynomials to try after some whose error was so many times the wanted one.
  int points_after(int points, double excess) const {
    const double growth = by_tooth_ ? std::min(kLargestGrowth, std::pow(excess, 1 / kOrderByTooth)) : 1;
    return std::max(more_points(points), static_cast<int>(growth * points));
  }

  std::vector<StabilityCrossing> crossings(const CirclePassages& passages, const PeriodForce& force) const {
    std::vector<StabilityCrossing> result;
    for (const CirclePassage* passage : boundaries_among(passages.found)) {
      const Eigen::VectorXcd numbers = force.lift * passage->difference;
      const Chatter chatter =
          chatter_of(structure_, period_s_, passage->multiplier(), forces_of(force.nodes, numbers));
      result.push_back(
          crossing_of(passage->depth_m, passage->outwards, chatter, structure_, tooth_period_s_));
    }
    return result;
  }

 private:
  const TipStructure& structure_;
  double revolutions_per_s_, tooth_period_s_;
  bool by_tooth_;
  CutSchedule schedule_;
  double period_s_;
};

std::vector<StabilityCrossing> crossings_of(const TipStructure& structure, const HelicalLimits& helical,
                                            double tooth_period_s) {
  std::vector<StabilityCrossing> result;
  for (const HelicalLimit& limit : helical.limits) {
    const Chatter chatter = chatter_of(structure, tooth_period_s, limit.multiplier, limit.forces);
    result.push_back(crossing_of(limit.depth_m, limit.unstable_above, chatter, structure, tooth_period_s));
  }
  return result;
}

bool is_helical_and_stable(const TipStructure& structure, const Cutter& cutter) {
  return is_helical_for_the_circle(cutter) && structure.lambda.real().maxCoeff() < 0;
}

bool is_straight_and_stable(const TipStructure& structure, const Cutter& cutter) {
  return !cutter.changes_with_depth() && structure.lambda.real().maxCoeff() < 0;
}

}  // namespace

std::optional<SpeedLimits> circle_limits(const TipStructure& structure, const Cutter& cutter,
                                         double revolutions_per_s, double largest_depth_m) {
  const double tooth_period_s = cutter.tooth_period_s(revolutions_per_s);
  if (is_helical_and_stable(structure, cutter)) {
    const auto helical = helical_limits(structure, cutter, revolutions_per_s, largest_depth_m,
                                        point_plan(structure, cutter, revolutions_per_s, largest_depth_m));
    if (!helical) return std::nullopt;
    refuse_useless(revolutions_per_s, helical->error);
    return SpeedLimits{crossings_of(structure, *helical, tooth_period_s), helical->error, helical->points};
  }
  if (!is_straight_and_stable(structure, cutter)) return std::nullopt;
  const StraightCut cut(structure, cutter, revolutions_per_s);
  PointPlan plan = point_plan(structure, cutter, revolutions_per_s, largest_depth_m);
  if (!cutter.equal_pitch()) plan = plan_by_tooth(structure, cutter, revolutions_per_s);
  SpeedLimits limits;
  limits.error = std::numeric_limits<double>::infinity();
  int doubts = 0;
  for (int points = plan.first;;) {
    const int finer = more_points(points);
    const PeriodForce all = cut.force(finer), here = with_fewer(all, points);
    if (!cut.suits_the_circle(here)) return std::nullopt;
    CirclePassages passages = circle_passages(here.whole, largest_depth_m);
    if (!passages.confirmed) return std::nullopt;
    const auto [error, doubtful] = carried_over(passages, all.whole);
    // Which passages there are is resolved beyond how exactly they are known.
    const bool better = error < limits.error || (doubts > 0 && error <= plan.wanted);
    if (better) limits = {cut.crossings(passages, here), error, points};
    if (doubtful) ++doubts;
    const bool enough = error <= plan.wanted && (!doubtful || doubts > kMostDoubts);
    if (!better || enough || finer > plan.most) break;
    // With modes without mass a tooth's entry bends the motion of the others so sharply that polynomials
    // along their whole way through the cut converge slowly.
    points = cut.points_after(points, std::max(1.0, error / plan.wanted));
  }
  refuse_useless(revolutions_per_s, limits.error);
  return limits;
}

std::vector<StabilityCrossing> scanned_crossings(const DepthScan& scan, const PeriodMap& map,
                                                 double tooth_period_s) {
  std::vector<StabilityCrossing> crossings;
  for (const StabilityBoundary& boundary : scan.boundaries()) {
    const Chatter chatter = chatter_at(map, boundary.depth_m, boundary.multiplier);
    crossings.push_back(
        crossing_of(boundary.depth_m, boundary.unstable_above, chatter, map.structure(), tooth_period_s));
  }
  return crossings;
}

std::vector<StabilityCrossing> crossings_at(const TipStructure& structure, const Cutter& cutter,
                                            double revolutions_per_s, double largest_depth_m, int points) {
  if (is_straight_and_stable(structure, cutter)) {
    const StraightCut cut(structure, cutter, revolutions_per_s);
    // What is known of an unequal pitch may come from a scan, which has fewer points on shorter pieces.
    const int polynomials = cutter.equal_pitch()
                                ? points
                                : std::max(points, plan_by_tooth(structure, cutter, revolutions_per_s).first);
    const PeriodForce force = cut.force(polynomials);
    if (cut.suits_the_circle(force)) {
      const CirclePassages passages = circle_passages(force.whole, largest_depth_m);
      if (passages.confirmed) return cut.crossings(passages, force);
    }
  }
  if (is_helical_and_stable(structure, cutter)) {
    const PointPlan as_given{points, 0, 0};
    if (const auto helical = helical_limits(structure, cutter, revolutions_per_s, largest_depth_m, as_given))
      return crossings_of(structure, *helical, cutter.tooth_period_s(revolutions_per_s));
  }
  const SpectralMap map(structure, cutter, revolutions_per_s, points);
  try {
    return scanned_crossings(DepthScan(map, largest_depth_m, DepthScan::kForLimits), map,
                             cutter.tooth_period_s(revolutions_per_s));
  } catch (const InvalidArgument& error) {
    throw no_answer_at(revolutions_per_s, error.what());
  }
}

const StabilityCrossing* limit_of(const std::vector<StabilityCrossing>& crossings) {
  const auto lowest = std::find_if(crossings.begin(), crossings.end(),
                                   [](const StabilityCrossing& c) { return c.unstable_above; });
  return lowest == crossings.end() ? nullptr : &*lowest;
}

bool stable_between(const std::vector<StabilityCrossing>& crossings, double depth_m) {
  const auto below = std::find_if(crossings.begin(), crossings.end(),
                                  [&](const StabilityCrossing& c) { return c.depth_m >= depth_m; });
  return (below - crossings.begin()) % 2 == 0;
}

std::optional<double> limit_depth(const TipStructure& structure, const Cutter& cutter,
                                  double revolutions_per_s, StabilityMethod method, int resolution,
                                  double largest_depth_m) {
  if (method == StabilityMethod::kSpectral) {
    const auto crossings = crossings_at(structure, cutter, revolutions_per_s, largest_depth_m, resolution);
    return crossings.empty() ? std::nullopt : std::optional(crossings.front().depth_m);
  }
  const SemiDiscretizationMap map(structure, cutter, revolutions_per_s, resolution);
  const auto boundaries = DepthScan(map, largest_depth_m, DepthScan::kForLimits).boundaries();
  return boundaries.empty() ? std::nullopt : std::optional(boundaries.front().depth_m);
}

int lobe_number(double chatter_frequency_hz, double tooth_period_s) {
  return static_cast<int>(std::floor(chatter_frequency_hz * tooth_period_s + kWholeWave));
}

}  // namespace stablecut::milling
