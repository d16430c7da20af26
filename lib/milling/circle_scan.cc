#include "milling/circle_scan.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/units.h"
#include "milling/circle_count.h"
#include "milling/circle_lanes.h"
#include "milling/circle_reduction.h"
#include "milling/circle_search.h"
#include "milling/circle_touches.h"

namespace stablecut::milling {
namespace {

using Complex = std::complex<double>;

// Newton's method on the whole operator: steps, radians of one, and how near an eigenvalue is to the step's
// before where only that is wanted.
constexpr int kMostSteps = 8;
constexpr double kLargestStep = kPi / 24, kSameValue = 1e-6;
constexpr int kMostCounts = 4;
// The search has this share of an arc's polynomials, and so many more; all where fewer than kLeastFew would
// be left; and half of what is missing more where the count is not confirmed.
constexpr double kShareOfPoints = 0.6;
constexpr Eigen::Index kMorePolynomials = 2, kLeastFew = 6;
// An eigenvalue of the search may be wrong by so many times what some of them are seen to be.
constexpr double kMarginOfMove = 10;
// Operators of more rows are searched in a space that has their large eigenvalues: what acts with less than
// this share of what limits at the largest depth is left out, and with each attempt so much less.
constexpr Eigen::Index kManyWhole = 26;
constexpr double kLeadingShare = 0.7, kSmallerShare = 0.25;
// How often what vectors lack is added to that space, until it changes eigenvalues by less than this share.
constexpr int kMostEnrichments = 5;
constexpr double kResolved = 1e-9;
// Changes of a multiplier up to which passages are carried over to a finer operator.
constexpr double kCarried = 1e-5;

// Newton's method on an operator, eight at a time: where the eigenvalue is real.
class Refinement {
 public:
  // `basis`: the operator's rows, of the rows that passages are to have; none: they are the same.
  explicit Refinement(const CircleOperator& of, const Eigen::MatrixXd* basis = nullptr)
      : lanes_(of), basis_(basis) {}
  CircleLanes& lanes() { return lanes_; }

  // From each start to the passage (or eigenvalue) near it, those that do not get there are left out.
  std::vector<CirclePassage> passages(const std::vector<Start>& starts) {
    std::vector<CirclePassage> result;
    for (std::size_t first = 0; first < starts.size(); first += CircleLanes::kPlaces) {
      auto eight = CircleLanes::eight_from(starts, first);
      const std::size_t count = std::min(CircleLanes::kPlaces, starts.size() - first);
      std::vector<std::size_t> underway(count);
      std::iota(underway.begin(), underway.end(), std::size_t{0});
      for (int step = 0; step < kMostSteps && !underway.empty(); ++step) {
        const EigenvalueLanes eigen = values_near(eight);
        std::erase_if(underway, [&](std::size_t i) {
          const bool there = arrived(eight[i], eigen.value[i], eigen.slope[i]);
          if (there)
            result.push_back(passage(eight[i], starts[first + i], eigen.value[i], eigen.slope[i], i));
          else
            eight[i] = next(eight[i], eigen.value[i], eigen.slope[i]);
          return there;
        });
      }
    }
    return result;
  }

  // The eigenvalues near those of the starts, at their angles, as passages.
  std::vector<CirclePassage> at(const std::vector<Start>& starts) {
    std::vector<CirclePassage> result;
    for (std::size_t first = 0; first < starts.size(); first += CircleLanes::kPlaces) {
      const auto eight = CircleLanes::eight_from(starts, first);
      const EigenvalueLanes eigen = values_near(eight);
      for (std::size_t i = 0; i < CircleLanes::kPlaces && first + i < starts.size(); ++i)
        result.push_back(passage(eight[i], eight[i], eigen.value[i], eigen.slope[i], i));
    }
    return result;
  }

 private:
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

  static bool arrived(const Start& at, Complex value, Complex slope) {
    if (at.seek == Seek::kTouch)  // what is left changes the imaginary part by so much
      return slope.imag() * slope.imag() < kOnAxis * std::abs(at.curvature * value);
    if (at.seek == Seek::kAxis) return std::abs(value.imag()) < kOnAxis * std::abs(value);
    return std::abs(value - at.value) < kSameValue * std::abs(value);
  }

  static Start next(Start at, Complex value, Complex slope) {
    double step = 0;
    if (at.seek == Seek::kAxis) step = -value.imag() / slope.imag();
    if (at.seek == Seek::kTouch) step = -slope.imag() / at.curvature;
    step = std::clamp(step, -kLargestStep, kLargestStep);
    at.value = value + slope * step;
    at.angle = std::clamp(at.angle + step, 0.0, kPi);
    return at;
  }

  CirclePassage passage(const Start& at, const Start& from, Complex value, Complex slope,
                        std::size_t place) const {
    CirclePassage passage;
    passage.angle = at.angle;
    passage.seek = at.seek;
    passage.curvature = at.curvature;
    passage.depth_m = 1 / value.real();
    passage.outwards = slope.imag() < 0;
    passage.value = value;
    passage.from = from.value;
    passage.slope = slope;
    passage.difference = lanes_.right(place);
    passage.left = lanes_.left(place);
    if (basis_ != nullptr) {
      passage.difference = *basis_ * passage.difference;
      passage.left = *basis_ * passage.left;
    }
    return passage;
  }

  CircleLanes lanes_;
  const Eigen::MatrixXd* basis_;
};

EigenTriple triple_of(const CirclePassage& passage) {
  return {passage.angle, passage.value, passage.difference.normalized(), passage.left.normalized()};
}

// The space that the search works in: a part of the whole operator's.
struct SearchSpace {
  Eigen::MatrixXd basis;  // [whole x rows]
  CircleOperator few;
};

// Passages of the whole operator from those of a part of its space, eight at a time: what the vectors lack is
// added to the space until nothing is. `search_error`: of an eigenvalue's size, how wrong those of the part
// may be.
std::vector<CirclePassage> passages_by_residuals(const CircleOperator& whole, const SearchSpace& space,
                                                 const std::vector<Start>& starts, double& search_error) {
  std::vector<CirclePassage> result;
  search_error = 0;
  for (std::size_t first = 0; first < starts.size(); first += CircleLanes::kPlaces) {
    const std::size_t end = std::min(first + CircleLanes::kPlaces, starts.size());
    const std::vector<Start> some(starts.begin() + first, starts.begin() + end);
    std::vector<CirclePassage> found = Refinement(space.few, &space.basis).at(some);
    Eigen::MatrixXd basis = space.basis;
    for (int turn = 0; turn < kMostEnrichments; ++turn) {
      std::vector<EigenTriple> triples;
      for (const CirclePassage& passage : found) triples.push_back(triple_of(passage));
      const Residuals lacking = residuals(whole, triples);
      double error = 0;
      for (std::size_t i = 0; i < found.size(); ++i)
        error = std::max(error, lacking.right.col(i).norm() * lacking.left.col(i).norm() /
                                    std::abs(triples[i].left.dot(triples[i].right)));
      if (turn == 0) search_error = std::max(search_error, error);
      if (turn > 0 && error < kResolved) {
        for (CirclePassage& passage : found) result.push_back(std::move(passage));
        break;
      }
      basis = enriched(basis, lacking);
      const CircleOperator more = projected(whole, basis);
      found = Refinement(more, &basis).passages(some);
    }
  }
  return result;
}

// Puts solved passages, touches and the nearest eigenvalue where they belong. Of an eigenvalue's size, how
// wrong those that they were sought from may be.
double sorted_in(std::vector<CirclePassage> solved, CirclePassages& result) {
  double moved = 0;
  for (CirclePassage& passage : solved) {
    if (passage.seek == Seek::kValue) {
      moved = std::max(moved, std::abs((passage.value - passage.from) / passage.value));
      result.nearest = std::move(passage);
    } else if (passage.seek == Seek::kTouch) {
      moved = std::max(moved, std::abs((passage.extremum() - passage.from.imag()) / passage.value));
      result.touches.push_back(std::move(passage));
    } else {
      result.found.push_back(std::move(passage));
    }
  }
  return kMarginOfMove * moved;
}

// By depth, each once. What ran into +1 or -1 while the angle was changed has been sought there by itself.
void put_in_order(std::vector<CirclePassage>& found) {
  std::erase_if(found,
                [](const CirclePassage& p) { return !p.is_real() && (p.angle == 0 || p.angle == kPi); });
  std::sort(found.begin(), found.end(),
            [](const CirclePassage& a, const CirclePassage& b) { return a.depth_m < b.depth_m; });
  found.erase(std::unique(found.begin(), found.end(), are_one), found.end());
}

// Whether the winding number of the searched operator agrees with what was found wherever it is known, and
// that of `at_top` at the largest depth.
bool are_counted(const std::vector<CirclePassage>& found, const CircleSearch& search, double largest_depth_m,
                 std::optional<int> at_top) {
  const std::vector<double> depths = depths_to_count_at(found, largest_depth_m);
  if (!at_top || *at_top != unstable_at(found, depths.back())) return false;
  return std::all_of(depths.begin(), depths.end(), [&](double depth) {
    const std::optional<int> count = search.count(depth);
    return !count || *count == unstable_at(found, depth);
  });
}

}  // namespace

CirclePassages circle_passages(const CircleOperator& whole, double largest_depth_m) {
  CirclePassages result;
  std::optional<Refinement> of_whole;
  const bool large = whole.size() > kManyWhole;
  if (!large) of_whole.emplace(whole);
  const Eigen::Index longest = whole.most();
  result.most = longest;
  auto most = static_cast<Eigen::Index>(kShareOfPoints * static_cast<double>(longest)) + kMorePolynomials;
  if (most < kLeastFew) most = longest;
  double share = kLeadingShare;
  for (int attempt = 0; attempt < kMostCounts; ++attempt) {
    const bool all = !large && most >= longest;
    SearchSpace space;
    if (large) {
      space.basis = leading_basis(whole, share / largest_depth_m);
      space.few = projected(whole, space.basis);
    } else if (!all) {
      space.few = chosen_rows(whole, whole.rows_of(most));
    }
    const CircleOperator& searched = all ? whole : space.few;
    if (searched.size() == 0) {  // nothing acts strongly enough to limit
      result.confirmed = true;
      break;
    }
    CircleSearch search(searched, largest_depth_m);
    search.settle();
    for (int again = 1; all && again < attempt; ++again) search.refine();
    std::vector<Start> starts = search.starts();
    const std::vector<RealPair> pairs = search.pairs();
    result.found.clear();
    result.touches.clear();
    result.pairs = pairs_of_whole(whole, pairs, starts);
    if (const auto nearest = search.nearest()) starts.push_back(*nearest);
    double error = 0;
    const auto solved = [&](const std::vector<Start>& some) {
      return large ? passages_by_residuals(whole, space, some, error) : of_whole->passages(some);
    };
    std::vector<CirclePassage> all_found = solved(starts);
    // What the search has and the whole operator has not may be the search's error, and its touch another
    // place.
    const bool lost = all_found.size() < starts.size() || result.pairs.size() < pairs.size();
    // Of an eigenvalue's size: how wrong the search's may be.
    const double margin = std::max(sorted_in(std::move(all_found), result), error);
    sorted_in(solved(starts_beside(result.touches)), result);
    put_in_order(result.found);

    // Of the whole operator at the largest depth, where that is small enough; of the search's, which is
    // cheap, at all.
    const double top = depths_to_count_at(result.found, largest_depth_m).back();
    std::optional<int> at_top;
    if (all || large) at_top = search.count(top);
    if (!at_top) {
      CircleLanes of_searched(searched);
      at_top = winding(large ? of_searched : of_whole->lanes(), search.angles(), top);
    }
    result.confirmed = are_counted(result.found, search, largest_depth_m, at_top);
    const bool doubtful = !all && (lost || search.touches(margin));
    if (result.confirmed && !doubtful) break;
    share *= kSmallerShare;
    most = doubtful ? longest : most + (longest - most + 1) / 2;
  }
  while (!result.found.empty() && result.found.back().depth_m > largest_depth_m) result.found.pop_back();
  return result;
}

Carried carried_over(CirclePassages& passages, const CircleOperator& finer) {
  std::vector<const CirclePassage*> judged = boundaries_among(passages.found);
  if (judged.empty() && passages.nearest) judged.push_back(&*passages.nearest);
  const std::vector<Eigen::Index> rows = finer.rows_of(passages.most);
  const auto value_there = [&](const CirclePassage& passage) {
    EigenTriple triple{passage.angle, passage.value, Eigen::VectorXcd::Zero(finer.size()),
                       Eigen::VectorXcd::Zero(finer.size())};
    triple.right(rows) = passage.difference;
    triple.left(rows) = passage.left;
    return corrected_value(finer, triple);
  };
  Carried carried{0, are_doubtful(passages, finer, value_there)};
  for (const CirclePassage* passage : judged)
    carried.change =
        std::max(carried.change, std::abs((value_there(*passage) - passage->value) / passage->slope));
  if (carried.change > kCarried) return carried;
  for (CirclePassage& passage : passages.found) {
    // One step of Newton's method; where the eigenvalue nearly touches the axis it would be a wild one.
    const Complex value = value_there(passage);
    const double step = passage.is_real() ? 0 : -value.imag() / passage.slope.imag();
    if (!(std::abs(step) < kCarried)) continue;
    passage.angle = std::clamp(passage.angle + step, 0.0, kPi);
    passage.value = value + step * passage.slope;
    passage.depth_m = 1 / passage.value.real();
  }
  return carried;
}

}  // namespace stablecut::milling
