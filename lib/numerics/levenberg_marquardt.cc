#include "numerics/levenberg_marquardt.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <vector>

namespace stablecut::numerics {
namespace {

constexpr double kFirstRadius = 1e4, kLeastRadius = 1e-32, kMostRadius = 1e16;
constexpr double kLeastSlack = 1e-6;      // of the damping's diagonal, beside (1 + |column of J|)^2
constexpr double kLeastDecrease = 1e-3;   // of what the quadratic model promises, for a step that is taken
constexpr double kMostGrowth = 3;         // of the radius, after a step as good as promised
constexpr double kFirstShrinkage = 2;     // of the radius after a step that is not taken; doubled each time
constexpr double kStepTolerance = 1e-13;  // relative size of a step that ends a search
// A search that was stopped has settled when the last steps brought a smaller share than that of the sum.
constexpr std::size_t kLastSteps = 20;
constexpr double kNextToNothing = 1e-3;
constexpr std::size_t kPatience = 240;  // steps after which one that has settled ends

// The steps of one search.
class Search {
 public:
  Search(const SumsOfSquares& sums, const Eigen::VectorXd& start, const Eigen::VectorXd& lower,
         const Eigen::VectorXd& upper)
      : sums_(sums),
        lower_(lower),
        upper_(upper),
        here_{start, sums(start, true)},
        floor_(kLeastSlack * (1 + here_.at.matrix.diagonal().array().max(0).sqrt()).square()) {}

  LeastSquares run(const LeastSquaresEffort& effort) {
    std::vector<double> history{here_.at.sum_of_squares};
    const auto settled = [&] {
      return history.size() > kLastSteps &&
             history[history.size() - 1 - kLastSteps] - history.back() < kNextToNothing * history.back();
    };
    for (int step = 0; step < effort.steps && radius_ > kLeastRadius && !here_.converged; ++step) {
      take_step(effort.tolerance);
      history.push_back(here_.at.sum_of_squares);
      if (history.size() > kPatience && settled()) break;
    }
    here_.converged = here_.converged || settled();
    return std::move(here_);
  }

 private:
  void take_step(double tolerance) {
    const NormalEquations& now = here_.at;
    if (now.gradient.isZero(0)) {
      here_.converged = true;
      return;
    }
    damped_ = now.matrix;
    damped_.diagonal().array() += now.matrix.diagonal().array().max(floor_) / radius_;
    factor_.compute(damped_);
    const Eigen::VectorXd step = factor_.solve(-now.gradient);
    const double promised = -step.dot(2 * now.gradient + now.matrix * step);
    if (factor_.info() != Eigen::Success || !(promised > 0)) return shrink();
    const Eigen::VectorXd trial = (here_.x + step).cwiseMax(lower_).cwiseMin(upper_);
    const double change = now.sum_of_squares - sums_(trial, false).sum_of_squares;
    const bool small =
        taken_one_ && (trial - here_.x).norm() <= kStepTolerance * (here_.x.norm() + kStepTolerance);
    if (small || std::abs(change) <= tolerance * now.sum_of_squares) {
      here_.converged = true;
      return;
    }
    const double quality = change / promised;
    if (!(quality > kLeastDecrease)) return shrink();
    here_.x = trial;
    here_.at = sums_(trial, true);
    taken_one_ = true;
    radius_ = std::min(kMostRadius, radius_ / std::max(1 / kMostGrowth, 1 - std::pow(2 * quality - 1, 3)));
    shrinkage_ = kFirstShrinkage;
  }

  void shrink() {
    radius_ /= shrinkage_;
    shrinkage_ *= 2;
  }

  const SumsOfSquares& sums_;
  const Eigen::VectorXd &lower_, &upper_;
  LeastSquares here_;
  Eigen::ArrayXd floor_;  // [n]
  Eigen::MatrixXd damped_;
  Eigen::LLT<Eigen::MatrixXd> factor_;
  double radius_ = kFirstRadius, shrinkage_ = kFirstShrinkage;
  bool taken_one_ = false;
};

}  // namespace

LeastSquares levenberg_marquardt(const SumsOfSquares& sums, const Eigen::VectorXd& start,
                                 const Eigen::VectorXd& lower, const Eigen::VectorXd& upper,
                                 const LeastSquaresEffort& effort) {
  return Search(sums, start, lower, upper).run(effort);
}

}  // namespace stablecut::numerics
