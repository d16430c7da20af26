#include "milling/helical_limits.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/units.h"
#include "milling/circle_operator.h"
#include "milling/circle_reduction.h"
#include "milling/collocation.h"
#include "milling/cut_schedule.h"
#include "milling/helical_force.h"
#include "milling/helical_passages.h"
#include "milling/spectral.h"

namespace stablecut::milling {
namespace {

using Complex = std::complex<double>;

// Polynomials along the whole arc, beside the radians that the fastest mode turns in half of it: what they
// lack moves the search's values by some 1e-4, and the pieces of the passage's depth put it right.
constexpr double kFirstPolynomials = 7;
// More radians than this are left to the depth scan.
constexpr double kMostRadiansOfArc = 24;
// Steps by the pieces' operator, and the share of the depth that a last one may be.
constexpr int kMostStepsByPieces = 4;
constexpr double kLastStep = 3e-5;

class ByPieces {
 public:
  ByPieces(const TipStructure& structure, const Cutter& cutter, double revolutions_per_s)
      : structure_(structure), cutter_(cutter), revolutions_per_s_(revolutions_per_s) {}

  // The limit near a passage, and how far its multiplier is from that of more polynomials.
  std::pair<HelicalLimit, double> limit(HelicalPassage p, int points) const {
    double error = 0;
    HelicalLimit limit;
    for (int step = 0; step < kMostStepsByPieces; ++step) {
      const Pair pair = operators_at(p.depth_m, points);
      const Values values = values_near(pair, p.angle, 1 / p.depth_m);
      error = std::abs((values.finer - values.here.value) / p.slope);
      const Eigen::VectorXcd numbers = pair.here.lift * values.here.right;
      limit.forces = forces_of(pair.here.nodes, numbers);
      const PassageStep change = step_from(p, values.finer);
      p.angle = std::clamp(p.angle + change.angle, 0.0, kPi);
      p.depth_m += change.depth_m;
      if (std::abs(change.depth_m) < kLastStep * p.depth_m) break;
    }
    limit.depth_m = p.depth_m;
    limit.unstable_above = p.outwards;
    limit.multiplier = p.multiplier();
    return {std::move(limit), error};
  }

  // The same of an eigenvalue that is no limit, at a depth; of the eigenvalue's size.
  double error_of(const Start& at, double depth_m, int points) const {
    const Pair pair = operators_at(depth_m, points);
    const Values values = values_near(pair, at.angle, at.value);
    return std::abs(values.finer - values.here.value) * depth_m;
  }

 private:
  struct Pair {
    PeriodForce finer, here;
  };
  struct Values {
    EigenTriple here;
    Complex finer;
  };

  Pair operators_at(double depth_m, int points) const {
    const Collocation c = collocate(structure_, cut_schedule(cutter_, revolutions_per_s_, depth_m),
                                    revolutions_per_s_, more_points(points));
    Pair pair{period_force(structure_, c, cutter_.tooth_period_s(revolutions_per_s_)), {}};
    pair.here = with_fewer(pair.finer, points);
    return pair;
  }

  static Values values_near(const Pair& pair, double angle, Complex near) {
    Values values{eigenvalue_near(pair.here.whole, angle, near), {}};
    const CircleOperator& finer = pair.finer.whole;
    const std::vector<Eigen::Index> rows = finer.rows_of(pair.here.whole.most());
    EigenTriple triple{angle, values.here.value, Eigen::VectorXcd::Zero(finer.size()),
                       Eigen::VectorXcd::Zero(finer.size())};
    triple.right(rows) = values.here.right;
    triple.left(rows) = values.here.left;
    values.finer = corrected_value(finer, triple);
    return values;
  }

  const TipStructure& structure_;
  const Cutter& cutter_;
  double revolutions_per_s_;
};

}  // namespace

bool is_helical_for_the_circle(const Cutter& cutter) {
  return cutter.lag_rad_per_m != 0 && cutter.corner_radius_m == 0 && cutter.equal_pitch() &&
         cutter.damping_n_per_m == 0;
}

std::optional<HelicalLimits> helical_limits(const TipStructure& structure, const Cutter& cutter,
                                            double revolutions_per_s, double largest_depth_m,
                                            const PointPlan& plan) {
  const double radians = structure.lambda.imag().cwiseAbs().maxCoeff() *
                         helical_arc(cutter, largest_depth_m).length_rad / (2 * kTwoPi * revolutions_per_s);
  if (radians > kMostRadiansOfArc) return std::nullopt;
  const HelicalForce force(structure, cutter, revolutions_per_s, largest_depth_m,
                           static_cast<int>(kFirstPolynomials + radians));
  const HelicalPassages passages = helical_passages(force, largest_depth_m);
  if (!passages.confirmed) return std::nullopt;
  const ByPieces pieces(structure, cutter, revolutions_per_s);
  const std::vector<const HelicalPassage*> boundaries = boundaries_among(passages.found);
  HelicalLimits best;
  best.error = std::numeric_limits<double>::infinity();
  for (int points = plan.first;;) {
    HelicalLimits now;
    now.points = points;
    for (const HelicalPassage* passage : boundaries) {
      auto [limit, error] = pieces.limit(*passage, points);
      now.error = std::max(now.error, error);
      now.limits.push_back(std::move(limit));
    }
    if (passages.found.empty() && passages.nearest)
      now.error = pieces.error_of(*passages.nearest, largest_depth_m, points);
    const bool better = now.error < best.error;
    if (better) best = std::move(now);
    const int finer = more_points(points);
    if (!better || best.error <= plan.wanted || finer > plan.most) break;
    points = finer;
  }
  return best;
}

}  // namespace stablecut::milling
