#include "milling/limits.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/units.h"
#include "milling/circle_scan.h"
#include "milling/semi_discretization.h"
#include "milling/spectral.h"

namespace stablecut::milling {
namespace {

using Complex = std::complex<double>;

// A product of frequency and period this far below a whole number is that number: a multiplier counts as real
// within 1e-7 of its size, 1.6e-8 of a wave.
constexpr double kWholeWave = 1e-6;

// Operators of more rows than kManyRows, and of more than kLongCut times the structure's state, are left to
// the depth scan, whose leading eigenvalues cost less there.
constexpr Eigen::Index kManyRows = 96, kLongCut = 2;
// Pieces of unequal pitch have so many rows that the depth scan costs less from here on.
constexpr Eigen::Index kManyRowsByTooth = 48;

void describe(const Chatter& chatter, const TipStructure& structure, double tooth_period_s,
              StabilityCrossing& crossing) {
  crossing.kind = chatter.kind;
  crossing.chatter_frequency_hz = chatter.frequency_hz;
  crossing.lobe = lobe_number(chatter.frequency_hz, tooth_period_s);
  Eigen::Index mode = 0;
  crossing.participation = chatter.participation.maxCoeff(&mode);
  crossing.mode = structure.source[mode];
}

// A cut whose teeth are where they are at every depth.
class StraightCut {
 public:
  StraightCut(const TipStructure& structure, const Cutter& cutter, double revolutions_per_s)
      : structure_(structure),
        revolutions_per_s_(revolutions_per_s),
        tooth_period_s_(cutter.tooth_period_s(revolutions_per_s)),
        schedule_(cut_schedule(cutter, revolutions_per_s, 0)),
        period_s_(schedule_.period_rad / (kTwoPi * revolutions_per_s)) {}

  Collocation collocation(int points) const {
    return collocate(structure_, schedule_, revolutions_per_s_, points);
  }
  bool suits_the_circle(const Collocation& c) const {
    const auto rows = static_cast<Eigen::Index>(c.rows.size());
    if (schedule_.passes > 1 && rows > kManyRowsByTooth) return false;
    return rows <= std::max(kManyRows, kLongCut * 2 * structure_.modes());
  }
  CirclePassages passages(const Collocation& c, double largest_depth_m) const {
    return circle_passages(structure_, c, period_s_, largest_depth_m);
  }
  CircleOperator whole(const Collocation& c) const { return circle_operator(structure_, c, period_s_); }

  std::vector<StabilityCrossing> crossings(const CirclePassages& passages, const Collocation& c) const {
    std::vector<StabilityCrossing> result;
    for (const CirclePassage* passage : passages.boundaries()) {
      StabilityCrossing crossing;
      crossing.depth_m = passage->depth_m;
      crossing.unstable_above = passage->outwards;
      const std::vector<ForceImpulse> forces = forces_of(c, passage->difference);
      const Complex multiplier =
          passage->is_real ? Complex(passage->angle > kPi / 2 ? -1.0 : 1.0) : std::polar(1.0, passage->angle);
      describe(chatter_of(structure_, period_s_, multiplier, forces), structure_, tooth_period_s_, crossing);
      result.push_back(crossing);
    }
    return result;
  }

 private:
  const TipStructure& structure_;
  double revolutions_per_s_, tooth_period_s_;
  CutSchedule schedule_;
  double period_s_;
};

bool is_straight_and_stable(const TipStructure& structure, const Cutter& cutter) {
  return cutter.lag_rad_per_m == 0 && structure.lambda.real().maxCoeff() < 0;
}

}  // namespace

std::optional<SpeedLimits> circle_limits(const TipStructure& structure, const Cutter& cutter,
                                         double revolutions_per_s, double largest_depth_m) {
  if (!is_straight_and_stable(structure, cutter)) return std::nullopt;
  const StraightCut cut(structure, cutter, revolutions_per_s);
  const PointPlan plan = point_plan(structure, cutter, revolutions_per_s, largest_depth_m);
  int points = plan.first;
  Collocation here = cut.collocation(points);
  SpeedLimits limits;
  limits.error = std::numeric_limits<double>::infinity();
  for (;;) {
    if (!cut.suits_the_circle(here)) return std::nullopt;
    const CirclePassages passages = cut.passages(here, largest_depth_m);
    if (!passages.confirmed) return std::nullopt;
    const int finer = more_points(points);
    Collocation fine = cut.collocation(finer);
    const double error = largest_change(passages, cut.whole(fine));
    const bool better = error < limits.error;
    if (better) limits = {cut.crossings(passages, here), error, points};
    if (!better || error <= plan.wanted || finer > plan.most) break;
    points = finer;
    here = std::move(fine);
  }
  refuse_useless(revolutions_per_s, limits.error);
  return limits;
}

std::vector<StabilityCrossing> scanned_crossings(const DepthScan& scan, const PeriodMap& map,
                                                 double tooth_period_s) {
  std::vector<StabilityCrossing> crossings;
  for (const StabilityBoundary& boundary : scan.boundaries()) {
    StabilityCrossing crossing;
    crossing.depth_m = boundary.depth_m;
    crossing.unstable_above = boundary.unstable_above;
    describe(chatter_at(map, boundary.depth_m, boundary.multiplier), map.structure(), tooth_period_s,
             crossing);
    crossings.push_back(crossing);
  }
  return crossings;
}

std::vector<StabilityCrossing> crossings_at(const TipStructure& structure, const Cutter& cutter,
                                            double revolutions_per_s, double largest_depth_m, int points) {
  if (is_straight_and_stable(structure, cutter)) {
    const StraightCut cut(structure, cutter, revolutions_per_s);
    const Collocation c = cut.collocation(points);
    if (cut.suits_the_circle(c)) {
      const CirclePassages passages = cut.passages(c, largest_depth_m);
      if (passages.confirmed) return cut.crossings(passages, c);
    }
  }
  const SpectralMap map(structure, cutter, revolutions_per_s, points);
  return scanned_crossings(DepthScan(map, largest_depth_m, DepthScan::kForLimits), map,
                           cutter.tooth_period_s(revolutions_per_s));
}

const StabilityCrossing* limit_of(const std::vector<StabilityCrossing>& crossings) {
  const auto lowest = std::find_if(crossings.begin(), crossings.end(),
                                   [](const StabilityCrossing& c) { return c.unstable_above; });
  return lowest == crossings.end() ? nullptr : &*lowest;
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
