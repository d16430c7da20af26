#include "milling/helical_passages.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "base/units.h"
#include "milling/circle_count.h"
#include "milling/circle_lanes.h"

namespace stablecut::milling {
namespace {

using Complex = std::complex<double>;

// Newton's method on angle and depth: steps, the largest ones (radians, share of the largest depth), and what
// ends it.
constexpr int kMostStepsInDepth = 10;
constexpr double kLargestTurn = kPi / 24, kLargestDepthStep = 0.2, kArrived = 1e-6;
// Differences for derivatives: radians, and share of the depth.
constexpr double kAngleDifference = 1e-6, kDepthDifference = 1e-4;
// Inverse iteration: solutions, and the shift beside the value.
constexpr int kSolutionsNear = 3;
constexpr double kOffsetNear = 1e-10;
// What acts with less than this share of what limits at the largest depth is left out of the search.
constexpr double kHelicalShare = 0.3;
// How often a panel of depth may be halved; how many equal ones are searched at most where the count
// disagrees; and how far beyond its ends a panel's starts are followed, of its width.
constexpr int kMostHalvings = 3, kMostPanels = 4;
constexpr double kBeyond = 0.5;
// The search's values may be wrong by so many times what one of them is seen to be.
constexpr double kMarginInDepth = 3, kLeastMove = 1e-3;
// Depths below this share of a panel's high end are as good as none.
constexpr double kLeastDepth = 1e-3;
// Results that are one: radians, and share of the depth.
constexpr double kSamePassage = 1e-5;

class Search {
 public:
  Search(const HelicalForce& force, double largest_depth_m) : force_(force), top_(largest_depth_m) {}

  HelicalPassages operator()() {
    for (int panels = 1; panels <= kMostPanels && !result_.confirmed; panels *= 2) {
      bool certain = true;
      for (int k = 0; k < panels && certain; ++k)
        certain = search_panel(top_ * k / panels, top_ * (k + 1) / panels, kMostHalvings);
      if (!certain) break;
      sort();
      result_.confirmed = is_counted();
    }
    while (!result_.found.empty() && result_.found.back().depth_m > top_) result_.found.pop_back();
    if (result_.found.empty() && result_.nearest) set_nearest_at_top();
    return std::move(result_);
  }

 private:
  CircleOperator at(double depth_m) const { return force_.operator_of(force_.forces(depth_m)); }

  // Panels in which it is not certain what crosses the axis are halved. Whether all became certain. What has
  // arrived is a passage, whichever panel it was found from.
  bool search_panel(double low, double high, int halvings) {
    if (is_certain(low, high)) return true;
    if (halvings == 0) return false;
    const double middle = (low + high) / 2;
    return search_panel(low, middle, halvings - 1) && search_panel(middle, high, halvings - 1);
  }

  bool is_certain(double low, double high) {
    const double middle = (low + high) / 2;
    const CircleOperator searched = at(middle);
    const Eigen::MatrixXd basis = leading_basis(searched, kHelicalShare / high);
    if (basis.cols() == 0) return true;
    const CircleOperator few = projected(searched, basis);
    const DepthVariation variation{low, middle, high, projected(at(low), basis), projected(at(high), basis)};
    CircleSearch search(few, high, &variation);
    search.settle();
    std::vector<Start> found_at;
    for (const Start& start : search.starts()) {
      const double depth = 1 / start.value.real(), beyond = kBeyond * (high - low);
      if (depth < low - beyond || depth > high + beyond) continue;
      const std::optional<HelicalPassage> found = passage_from(start);
      if (!found && depth > low && depth < high) return false;
      if (!found) continue;
      if (found->depth_m > low && found->depth_m < high)
        found_at.push_back({found->angle, found->value, found->seek});
      result_.found.push_back(*found);
    }
    const std::vector<Complex> searched_there = search.values_near(found_at);
    double margin = 0;  // of a value's size
    for (std::size_t i = 0; i < found_at.size(); ++i)
      margin = std::max(margin, std::abs(searched_there[i] / found_at[i].value - 1.0));
    margin = kMarginInDepth * std::max(margin, kLeastMove);
    if (search.turns_near_axis(margin, std::max(low, kLeastDepth * high) / (1 + margin))) return false;
    if (const auto nearest = search.nearest();
        nearest && (!result_.nearest || nearest->value.real() > result_.nearest->value.real()))
      result_.nearest = nearest;
    angles_ = search.angles();
    basis_ = basis;
    return true;
  }

  std::optional<HelicalPassage> passage_from(const Start& start) const {
    HelicalPassage p;
    p.angle = start.angle;
    p.depth_m = 1 / start.value.real();
    p.seek = start.seek;
    Complex near = start.value;
    for (int step = 0; step < kMostStepsInDepth; ++step) {
      const CircleOperator here = at(p.depth_m);
      const EigenTriple eigen = eigenvalue_near(here, p.angle, near);
      const Complex scale = eigen.left.dot(eigen.right);
      const auto quotient = [&](const CircleOperator& of, double angle) {
        return Complex(eigen.left.dot(of.times(angle, eigen.right).col(0))) / scale;
      };
      const double difference = kDepthDifference * p.depth_m;
      const Complex slope =
          (quotient(here, p.angle + kAngleDifference) - quotient(here, p.angle - kAngleDifference)) /
          (2 * kAngleDifference);
      const Complex by_depth = (quotient(at(p.depth_m + difference), p.angle) - eigen.value) / difference;
      p.by_angle = p.depth_m * slope;
      p.by_depth = eigen.value + p.depth_m * by_depth;
      const Complex excess = p.depth_m * eigen.value - 1.0;
      if (std::abs(p.is_real() ? excess.real() : std::abs(excess)) < kArrived) {
        p.value = eigen.value;
        p.slope = slope;
        p.difference = eigen.right;
        p.left = eigen.left;
        p.outwards = (p.by_depth / p.by_angle).imag() > 0;
        return p;
      }
      const PassageStep wanted = step_from(p, eigen.value);
      const double turn = std::clamp(wanted.angle, -kLargestTurn, kLargestTurn);
      const double deeper = std::clamp(wanted.depth_m, -kLargestDepthStep * top_, kLargestDepthStep * top_);
      near = eigen.value + slope * turn + by_depth * deeper;
      p.angle = std::clamp(p.angle + turn, 0.0, kPi);
      p.depth_m = std::max(p.depth_m + deeper, p.depth_m / 2);
    }
    return std::nullopt;
  }

  // The search has it at a depth of its own.
  void set_nearest_at_top() {
    const Eigen::VectorXcd values =
        Eigen::ComplexEigenSolver<Eigen::MatrixXcd>(at(top_).matrix(result_.nearest->angle), false)
            .eigenvalues();
    Eigen::Index best = 0;
    values.real().maxCoeff(&best);
    result_.nearest->value = values[best];
  }

  void sort() {
    auto& found = result_.found;
    std::sort(found.begin(), found.end(),
              [](const HelicalPassage& a, const HelicalPassage& b) { return a.depth_m < b.depth_m; });
    const auto same = [](const HelicalPassage& a, const HelicalPassage& b) {
      return std::abs(a.angle - b.angle) < kSamePassage &&
             std::abs(a.depth_m - b.depth_m) < kSamePassage * b.depth_m;
    };
    found.erase(std::unique(found.begin(), found.end(), same), found.end());
  }

  // Whether the winding number agrees with the passages at three depths.
  bool is_counted() const {
    if (basis_.cols() == 0) return true;
    const std::vector<CirclePassage> plain(result_.found.begin(), result_.found.end());
    const std::vector<double> depths = depths_to_count_at(plain, top_);
    for (const std::size_t i : {depths.size() / 4, depths.size() / 2, depths.size() - 1}) {
      const CircleOperator few = projected(at(depths[i]), basis_);
      CircleLanes lanes(few);
      const std::optional<int> counted = winding(lanes, angles_, depths[i]);
      if (!counted || *counted != unstable_at(plain, depths[i])) return false;
    }
    return true;
  }

  const HelicalForce& force_;
  double top_;
  HelicalPassages result_;
  std::vector<double> angles_;  // of the last panel's search
  Eigen::MatrixXd basis_;       // and its space
};

}  // namespace

HelicalPassages helical_passages(const HelicalForce& force, double largest_depth_m) {
  return Search(force, largest_depth_m)();
}

EigenTriple eigenvalue_near(const CircleOperator& of, double angle, Complex near) {
  const Eigen::Index size = of.size();
  const Eigen::MatrixXcd matrix = of.matrix(angle);
  Eigen::MatrixXcd shifted = matrix;
  shifted.diagonal().array() -= near * (1 + kOffsetNear);
  const Eigen::PartialPivLU<Eigen::MatrixXcd> inverse(shifted);
  EigenTriple result{angle, near, Eigen::VectorXcd::Ones(size), Eigen::VectorXcd::Ones(size)};
  for (int k = 0; k < kSolutionsNear; ++k) {
    result.right = inverse.solve(result.right).normalized();
    result.left = inverse.adjoint().solve(result.left).normalized();
  }
  result.value = Complex(result.left.dot(matrix * result.right)) / result.left.dot(result.right);
  return result;
}

PassageStep step_from(const HelicalPassage& at, Complex value) {
  const Complex excess = at.depth_m * value - 1.0;
  if (at.is_real()) return {0, -excess.real() / at.by_depth.real()};
  // by_angle * turn + by_depth * deeper = -excess, in real and imaginary part.
  const double determinant = (std::conj(at.by_angle) * at.by_depth).imag();
  return {(std::conj(at.by_depth) * excess).imag() / determinant,
          -(std::conj(at.by_angle) * excess).imag() / determinant};
}

}  // namespace stablecut::milling
