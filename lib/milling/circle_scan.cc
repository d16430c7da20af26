#include "milling/circle_scan.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/units.h"
#include "milling/arc_polynomials.h"
#include "milling/circle_lanes.h"
#include "milling/circle_search.h"

namespace stablecut::milling {
namespace {

using Complex = std::complex<double>;

// Newton's method on the whole operator: steps, radians of one, the imaginary part where it ends (of the
// size), and how near an eigenvalue is to the step's before where only that is wanted.
constexpr int kMostSteps = 8;
constexpr double kLargestStep = kPi / 24, kOnAxis = 1e-11, kSameValue = 1e-6;
// Results that are one: radians, and share of the depth.
constexpr double kSamePlace = 1e-8;
// Depths at which multipliers are counted, and how far below each in their distances.
constexpr int kCounts = 8;
constexpr double kBesideCount[] = {0, -0.1, -0.2, -0.3, -0.4};
constexpr int kMostCounts = 4;
// The search has this share of an arc's polynomials, and so many more; all where fewer than kLeastFew would
// be left; and half of what is missing more where the count is not confirmed.
constexpr double kShareOfPoints = 0.6;
constexpr Eigen::Index kMorePolynomials = 2, kLeastFew = 6;
// An eigenvalue of the search may be wrong by so many times what one of them is seen to be.
constexpr double kMarginOfMove = 10;
// Radians that a determinant's phase may change from place to place, and places at which that is given up.
constexpr double kMostTurnOfWhole = 1;
constexpr std::size_t kMostPlacesOfWhole = 6000;

// The number of multipliers outside the unit circle at a depth: det(I - depth M) goes round 0 that often,
// backwards, while mu goes once round the circle. Half of it is enough. Places are added where the phase
// changes by more than kMostTurnOfWhole; nothing is known where that does not end.
std::optional<int> winding(CircleLanes& lanes, std::vector<double> angles, double depth_m) {
  std::vector<std::pair<double, Complex>> known;  // angle, phase
  while (!angles.empty()) {
    for (std::size_t first = 0; first < angles.size(); first += CircleLanes::kPlaces) {
      const std::size_t count = std::min(CircleLanes::kPlaces, angles.size() - first);
      const CircleLanes::Angles eight = CircleLanes::eight_from(angles, first);
      lanes.form(eight);
      const auto phases = lanes.determinant_phases(depth_m);
      for (std::size_t i = 0; i < count; ++i) known.emplace_back(eight[i], phases[i]);
    }
    std::sort(known.begin(), known.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    angles.clear();
    double turn = 0;
    for (std::size_t i = 0; i + 1 < known.size(); ++i) {
      const double step = std::arg(known[i + 1].second * std::conj(known[i].second));
      turn += step;
      if (std::abs(step) > kMostTurnOfWhole) angles.push_back((known[i].first + known[i + 1].first) / 2);
    }
    if (angles.empty()) return -static_cast<int>(std::lround(turn / kPi));
    if (known.size() + angles.size() > kMostPlacesOfWhole) break;
  }
  return std::nullopt;
}

// Newton's method on the whole operator, eight at a time: where the eigenvalue is real.
class Refinement {
 public:
  Refinement(const CircleOperator& whole, const Eigen::VectorXd& weights)
      : lanes_(whole), weights_(weights) {}
  CircleLanes& lanes() { return lanes_; }

  // From each start to the passage (or eigenvalue) near it, by steps of at most `stretch`; those that do not
  // get there are left out.
  std::vector<CirclePassage> passages(const std::vector<Start>& starts, double stretch) {
    std::vector<CirclePassage> result;
    for (std::size_t first = 0; first < starts.size(); first += CircleLanes::kPlaces) {
      auto eight = CircleLanes::eight_from(starts, first);
      const std::size_t count = std::min(CircleLanes::kPlaces, starts.size() - first);
      std::vector<std::size_t> underway(count);
      std::iota(underway.begin(), underway.end(), std::size_t{0});
      for (int step = 0; step < kMostSteps && !underway.empty(); ++step) {
        const EigenvalueLanes eigen = values_near(eight);
        std::erase_if(underway, [&](std::size_t i) {
          const bool there = arrived(eight[i], eigen.value[i]);
          if (there)
            result.push_back(passage(eight[i], eigen.value[i], eigen.slope[i], i));
          else
            eight[i] = next(eight[i], eigen.value[i], eigen.slope[i], stretch);
          return there;
        });
      }
    }
    return result;
  }

  // The eigenvalues near those of the starts, at their angles.
  EigenvalueLanes values_near(const std::array<Start, CircleLanes::kPlaces>& starts) {
    CircleLanes::Angles angles;
    std::array<Complex, CircleLanes::kPlaces> shifts;
    for (std::size_t i = 0; i < starts.size(); ++i) {
      angles[i] = starts[i].angle;
      shifts[i] = starts[i].value;
    }
    lanes_.form(angles);
    return lanes_.refined(shifts);
  }

 private:
  static bool arrived(const Start& at, Complex value) {
    if (at.seek == Seek::kAxis) return std::abs(value.imag()) < kOnAxis * std::abs(value);
    return std::abs(value - at.value) < kSameValue * std::abs(value);
  }

  static Start next(Start at, Complex value, Complex slope, double stretch) {
    const double step =
        at.seek == Seek::kAxis ? std::clamp(-value.imag() / slope.imag(), -stretch, stretch) : 0.0;
    at.value = value + slope * step;
    at.angle = std::clamp(at.angle + step, 0.0, kPi);
    return at;
  }

  CirclePassage passage(const Start& at, Complex value, Complex slope, std::size_t place) const {
    CirclePassage passage;
    passage.angle = at.angle;
    passage.is_real = at.seek == Seek::kAtOne;
    passage.depth_m = 1 / value.real();
    passage.outwards = slope.imag() < 0;
    passage.value = value;
    passage.slope = slope;
    passage.difference = lanes_.right(place).cwiseQuotient(weights_.cast<Complex>());
    return passage;
  }

  CircleLanes lanes_;
  Eigen::VectorXd weights_;
};

// Depths up to the largest at which multipliers are counted, away from the passages.
std::vector<double> depths_to_count_at(const std::vector<CirclePassage>& found, double largest_depth_m) {
  std::vector<double> depths;
  for (int k = 1; k <= kCounts; ++k) {
    double best = 0, widest = -1;
    for (const double beside : kBesideCount) {
      const double depth = (k + beside) / kCounts * largest_depth_m;
      double nearest = largest_depth_m;
      for (const CirclePassage& p : found) nearest = std::min(nearest, std::abs(p.depth_m - depth));
      if (nearest > widest) {
        widest = nearest;
        best = depth;
      }
    }
    depths.push_back(best);
  }
  return depths;
}

// Polynomials, or nodes, on the longest arc.
Eigen::Index longest_arc(const Collocation& collocation) {
  Eigen::Index longest = 0;
  for (const RowPolynomial& row : collocation.polynomials) longest = std::max(longest, row.degree + 1);
  if (longest > 0) return longest;
  for (const CollocationArc& arc : collocation.arcs)
    longest = std::max(longest, static_cast<Eigen::Index>(arc.nodes.size()));
  return longest;
}

int unstable_at(const std::vector<CirclePassage>& found, double depth_m) {
  int count = 0;
  for (const CirclePassage& p : found)
    if (p.depth_m <= depth_m) count += p.change();
  return count;
}

}  // namespace

std::vector<const CirclePassage*> CirclePassages::boundaries() const {
  std::vector<const CirclePassage*> result;
  int outside = 0;
  for (const CirclePassage& passage : found) {
    const int after = outside + passage.change();
    if ((after > 0) != (outside > 0)) result.push_back(&passage);
    outside = after;
  }
  return result;
}

CirclePassages circle_passages(const TipStructure& structure, const Collocation& collocation, double period_s,
                               double largest_depth_m) {
  const CircleOperator whole = circle_operator(structure, collocation, period_s);
  const Eigen::Index longest = longest_arc(collocation);
  Refinement refinement(whole, root_weights(collocation));
  CirclePassages result;
  auto most = static_cast<Eigen::Index>(kShareOfPoints * static_cast<double>(longest)) + kMorePolynomials;
  if (most < kLeastFew) most = longest;
  for (int attempt = 0; attempt < kMostCounts; ++attempt, most += (longest - most + 1) / 2) {
    const bool all = most >= longest;
    const CircleOperator few = all ? whole : projected(whole, arc_polynomials(collocation, most));
    CircleSearch search(few, largest_depth_m);
    search.settle();
    for (int again = 1; all && again < attempt; ++again) search.refine();
    result.found = refinement.passages(search.starts(), kLargestStep);
    std::sort(result.found.begin(), result.found.end(),
              [](const CirclePassage& a, const CirclePassage& b) { return a.depth_m < b.depth_m; });
    const auto same = [](const CirclePassage& a, const CirclePassage& b) {
      return std::abs(a.angle - b.angle) < kSamePlace &&
             std::abs(a.depth_m - b.depth_m) < kSamePlace * b.depth_m;
    };
    result.found.erase(std::unique(result.found.begin(), result.found.end(), same), result.found.end());

    double moved = 0;
    if (const auto nearest = search.nearest()) {
      for (CirclePassage& passage : refinement.passages({*nearest}, 0)) {
        moved = std::abs(passage.value - nearest->value) / std::abs(passage.value);
        result.nearest = std::move(passage);
      }
    }
    const std::vector<double> depths = depths_to_count_at(result.found, largest_depth_m);
    const auto as_found = [&](double depth, std::optional<int> count) {
      return count && *count == unstable_at(result.found, depth);
    };
    // Of the whole operator at the largest depth; of the search's, which is cheap, at all.
    std::optional<int> at_top;
    if (all) at_top = search.count(depths.back());
    if (!at_top) at_top = winding(refinement.lanes(), search.angles(), depths.back());
    result.confirmed = as_found(depths.back(), at_top);
    for (const double depth : depths) {
      const std::optional<int> count = search.count(depth);
      result.confirmed = result.confirmed && (!count || as_found(depth, count));
    }
    if (!all && search.touches(kMarginOfMove * moved)) {
      most = longest;
      continue;
    }
    if (result.confirmed) break;
  }
  while (!result.found.empty() && result.found.back().depth_m > largest_depth_m) result.found.pop_back();
  return result;
}

double largest_change(const CirclePassages& passages, const CircleOperator& other) {
  std::vector<const CirclePassage*> all = passages.boundaries();
  if (all.empty() && passages.nearest) all.push_back(&*passages.nearest);
  std::vector<Start> starts;
  for (const CirclePassage* passage : all) starts.push_back({passage->angle, passage->value, Seek::kValue});
  Refinement there(other, Eigen::VectorXd::Ones(other.size()));
  double change = 0;
  for (std::size_t first = 0; first < all.size(); first += CircleLanes::kPlaces) {
    const EigenvalueLanes eigen = there.values_near(CircleLanes::eight_from(starts, first));
    for (std::size_t i = 0; i < CircleLanes::kPlaces && first + i < all.size(); ++i)
      change = std::max(change, std::abs((eigen.value[i] - all[first + i]->value) / all[first + i]->slope));
  }
  return change;
}

}  // namespace stablecut::milling
