#include "numerics/constrained_maximum.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <vector>

namespace stablecut::numerics {
namespace {

constexpr int kMostSteps = 300;
constexpr double kLeastRadius = 1e-10, kLargestRadius = 1;  // of the trust region
constexpr double kInside = 1e-12;                           // constraints are met with this to spare
constexpr int kMostCorrections = 6;  // steps that draw a point back on to the constraints
// The search for an allowed point: steps, and their largest size.
constexpr int kMostRestorations = 20;
constexpr double kLargestRestoration = 0.1;
// Differences: of the trust region, and at least of the step that was asked for.
constexpr double kDifferenceShare = 0.05, kLeastDifference = 0.1;
constexpr double kLeastCurvature = 1e-8;  // of the largest, that the model bends downwards everywhere
constexpr double kNearConstraint = 1.5;   // trust regions within which a constraint can matter
constexpr double kMultiplierRounding = 1e-12, kSlackRounding = 1e-9, kLeastBound = 1e-6;
// A step is good when it keeps this share of what the model promised, poor below the other; how much the
// trust region grows, shrinks, and shrinks where the step was in vain.
constexpr double kGood = 0.5, kPoor = 0.1, kGrowth = 2, kShrink = 0.5, kShrinkInVain = 0.3;

using Matrix = Eigen::MatrixXd;

// First and second derivatives of the value and of each constraint.
struct Derivatives {
  Variables gradient;
  Matrix hessian;
  Eigen::MatrixXd constraint_gradient;  // [constraints x variables]
  std::vector<Matrix> constraint_hessian;
};

std::optional<Derivatives> derivatives_at(const ConstrainedFunction& function, const Variables& x,
                                          const ConstrainedValue& here, double h) {
  const Eigen::Index n = x.size(), m = here.constraints.size();
  Derivatives d{Variables::Zero(n), Matrix::Zero(n, n), Eigen::MatrixXd::Zero(m, n),
                std::vector<Matrix>(m, Matrix::Zero(n, n))};
  const auto moved = [&](Eigen::Index i, double a, Eigen::Index j, double b) {
    Variables y = x;
    y[i] += a * h;
    y[j] += b * h;
    return function(y);
  };
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto plus = moved(i, 1, i, 0), minus = moved(i, -1, i, 0);
    if (!plus || !minus) return std::nullopt;
    d.gradient[i] = (plus->value - minus->value) / (2 * h);
    d.hessian(i, i) = (plus->value - 2 * here.value + minus->value) / (h * h);
    d.constraint_gradient.col(i) = (plus->constraints - minus->constraints) / (2 * h);
    for (Eigen::Index k = 0; k < m; ++k) {
      d.constraint_hessian[k](i, i) =
          (plus->constraints[k] - 2 * here.constraints[k] + minus->constraints[k]) / (h * h);
    }
    for (Eigen::Index j = 0; j < i; ++j) {
      const auto pp = moved(i, 1, j, 1), pm = moved(i, 1, j, -1), mp = moved(i, -1, j, 1),
                 mm = moved(i, -1, j, -1);
      if (!pp || !pm || !mp || !mm) return std::nullopt;
      d.hessian(i, j) = d.hessian(j, i) = (pp->value - pm->value - mp->value + mm->value) / (4 * h * h);
      for (Eigen::Index k = 0; k < m; ++k) {
        d.constraint_hessian[k](i, j) = d.constraint_hessian[k](j, i) =
            (pp->constraints[k] - pm->constraints[k] - mp->constraints[k] + mm->constraints[k]) / (4 * h * h);
      }
    }
  }
  return d;
}

// The same with no positive curvature, and a little negative everywhere.
Matrix concave(const Matrix& hessian) {
  const Eigen::Index n = hessian.rows();
  Eigen::Matrix3d padded = Eigen::Matrix3d::Zero();
  padded.topLeftCorner(n, n) = hessian;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(padded);
  const double least = kLeastCurvature * std::max(1.0, solver.eigenvalues().cwiseAbs().maxCoeff());
  const Eigen::Vector3d curvature = solver.eigenvalues().cwiseMin(-least);
  const Eigen::Matrix3d result =
      solver.eigenvectors() * curvature.asDiagonal() * solver.eigenvectors().transpose();
  return result.topLeftCorner(n, n);
}

struct QuadraticStep {
  Variables step;
  Eigen::VectorXd multipliers;  // one for each row
};

// The d that maximizes g.d + d^T H d / 2 under rows d >= bounds, H negative definite: the active set whose
// stationary point is feasible and has no negative multiplier, found by trying them all. Nothing when no
// point is feasible.
class QuadraticProgram {
 public:
  QuadraticProgram(const Variables& g, const Matrix& h, const Eigen::MatrixXd& rows,
                   const Eigen::VectorXd& bounds)
      : g_(g), h_(h), rows_(rows), bounds_(bounds) {}

  std::optional<QuadraticStep> solve() {
    std::vector<Eigen::Index> active;
    for (Eigen::Index size = 0; size <= g_.size(); ++size) {
      if (auto found = extend(active, 0, size)) return found;
    }
    return std::nullopt;
  }

 private:
  std::optional<QuadraticStep> extend(std::vector<Eigen::Index>& active, Eigen::Index first,
                                      Eigen::Index more) {
    if (more == 0) return stationary(active);
    for (Eigen::Index k = first; k < rows_.rows(); ++k) {
      active.push_back(k);
      auto found = extend(active, k + 1, more - 1);
      active.pop_back();
      if (found) return found;
    }
    return std::nullopt;
  }

  std::optional<QuadraticStep> stationary(const std::vector<Eigen::Index>& active) const {
    const Eigen::Index n = g_.size(), a = static_cast<Eigen::Index>(active.size());
    Eigen::MatrixXd system = Eigen::MatrixXd::Zero(n + a, n + a);
    Eigen::VectorXd right(n + a);
    system.topLeftCorner(n, n) = h_;
    right.head(n) = -g_;
    for (Eigen::Index i = 0; i < a; ++i) {
      system.row(n + i).head(n) = rows_.row(active[i]);
      system.col(n + i).head(n) = rows_.row(active[i]).transpose();
      right[n + i] = bounds_[active[i]];
    }
    const Eigen::FullPivLU<Eigen::MatrixXd> factors(system);
    if (!factors.isInvertible()) return std::nullopt;
    const Eigen::VectorXd solution = factors.solve(right);
    if ((solution.tail(a).array() < -kMultiplierRounding).any()) return std::nullopt;
    const Eigen::VectorXd slack = rows_ * solution.head(n) - bounds_;
    if ((slack.array() < -kSlackRounding * bounds_.array().abs().max(kLeastBound)).any()) return std::nullopt;
    QuadraticStep step{solution.head(n), Eigen::VectorXd::Zero(rows_.rows())};
    for (Eigen::Index i = 0; i < a; ++i) step.multipliers[active[i]] = solution[n + i];
    return step;
  }

  const Variables& g_;
  const Matrix& h_;
  const Eigen::MatrixXd& rows_;
  const Eigen::VectorXd& bounds_;
};

bool allowed(const ConstrainedValue& at) {
  return at.constraints.size() == 0 || at.constraints.minCoeff() >= 0;
}

// Draws a point back to where every constraint holds, by steps of least length along the gradients in
// `slopes`.
std::optional<ConstrainedMaximum> drawn_back(const ConstrainedFunction& function, Variables x,
                                             const Eigen::MatrixXd& slopes, const Variables& lower,
                                             const Variables& upper) {
  for (int i = 0; i <= kMostCorrections; ++i) {
    x = x.cwiseMax(lower).cwiseMin(upper);
    const auto at = function(x);
    if (!at) return std::nullopt;
    if (allowed(*at)) return ConstrainedMaximum{x, at->value};
    std::vector<Eigen::Index> violated;
    for (Eigen::Index k = 0; k < at->constraints.size(); ++k) {
      if (at->constraints[k] < 0) violated.push_back(k);
    }
    Eigen::MatrixXd a(violated.size(), x.size());
    Eigen::VectorXd missing(violated.size());
    for (std::size_t k = 0; k < violated.size(); ++k) {
      a.row(k) = slopes.row(violated[k]);
      missing[k] = kInside - at->constraints[violated[k]];
    }
    x += a.completeOrthogonalDecomposition().solve(missing);
  }
  return std::nullopt;
}

// From a point that is not allowed to one that is, by Gauss-Newton steps on what is violated.
std::optional<Variables> allowed_point(const ConstrainedFunction& function, Variables x,
                                       const Variables& lower, const Variables& upper, double difference) {
  for (int i = 0; i < kMostRestorations; ++i) {
    const auto at = function(x);
    if (!at) return std::nullopt;
    if (allowed(*at)) return x;
    const auto d = derivatives_at(function, x, *at, difference);
    if (!d) return std::nullopt;
    if (const auto found = drawn_back(function, x, d->constraint_gradient, lower, upper)) return found->point;
    const Eigen::VectorXd missing = (kInside - at->constraints.array()).max(0.0);
    Eigen::MatrixXd a = d->constraint_gradient;
    for (Eigen::Index k = 0; k < missing.size(); ++k) {
      if (missing[k] <= kInside) a.row(k).setZero();
    }
    Variables step = a.completeOrthogonalDecomposition().solve(missing);
    const double size = step.cwiseAbs().maxCoeff();
    if (size > kLargestRestoration) step *= kLargestRestoration / size;
    x = (x + step).cwiseMax(lower).cwiseMin(upper);
  }
  return std::nullopt;
}

}  // namespace

std::optional<ConstrainedMaximum> constrained_maximum(const ConstrainedFunction& function,
                                                      const Variables& start, const Variables& lower,
                                                      const Variables& upper, double radius,
                                                      double difference) {
  if (start.size() == 0) {
    const auto only = function(start);
    return only && allowed(*only) ? std::optional(ConstrainedMaximum{start, only->value}) : std::nullopt;
  }
  const auto first = allowed_point(function, start.cwiseMax(lower).cwiseMin(upper), lower, upper, difference);
  if (!first) return std::nullopt;
  Variables x = *first;
  auto here = *function(x);
  const Eigen::Index n = x.size(), m = here.constraints.size();
  std::optional<Derivatives> d;
  Eigen::VectorXd multipliers = Eigen::VectorXd::Zero(m);
  for (int count = 0; count < kMostSteps && radius > kLeastRadius; ++count) {
    // On a ridge that is narrow the trust region is small, and the differences with it.
    if (!d)
      d = derivatives_at(function, x, here,
                         std::clamp(kDifferenceShare * radius, kLeastDifference * difference, difference));
    if (!d) break;
    Matrix lagrangian = d->hessian;
    for (Eigen::Index k = 0; k < m; ++k) lagrangian += multipliers[k] * d->constraint_hessian[k];

    // Rows that can matter within the trust region; then its own box, cut by lower and upper.
    std::vector<Eigen::Index> near;
    for (Eigen::Index k = 0; k < m; ++k) {
      if (here.constraints[k] < kNearConstraint * radius * d->constraint_gradient.row(k).lpNorm<1>())
        near.push_back(k);
    }
    const Eigen::Index constraints = near.size();
    Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(constraints + 2 * n, n);
    Eigen::VectorXd bounds(constraints + 2 * n);
    for (Eigen::Index k = 0; k < constraints; ++k) {
      rows.row(k) = d->constraint_gradient.row(near[k]);
      bounds[k] = kInside - here.constraints[near[k]];
    }
    for (Eigen::Index i = 0; i < n; ++i) {
      rows(constraints + 2 * i, i) = 1;
      bounds[constraints + 2 * i] = std::max(-radius, lower[i] - x[i]);
      rows(constraints + 2 * i + 1, i) = -1;
      bounds[constraints + 2 * i + 1] = -std::min(radius, upper[i] - x[i]);
    }
    const Matrix model = concave(lagrangian);
    const auto step = QuadraticProgram(d->gradient, model, rows, bounds).solve();
    if (!step) {
      radius *= kShrink;
      continue;
    }
    const double length = step->step.cwiseAbs().maxCoeff();
    const auto candidate = drawn_back(function, x + step->step, d->constraint_gradient, lower, upper);
    if (candidate && candidate->value > here.value) {
      const double promised = d->gradient.dot(step->step) + 0.5 * step->step.dot(model * step->step);
      const double kept = candidate->value - here.value;
      if (kept > kGood * promised && length > radius / 2) radius = std::min(kGrowth * radius, kLargestRadius);
      if (kept < kPoor * promised) radius *= kShrink;
      x = candidate->point;
      here = *function(x);
      multipliers.setZero();
      for (Eigen::Index k = 0; k < constraints; ++k) multipliers[near[k]] = step->multipliers[k];
      d.reset();
    } else {
      radius = kShrinkInVain * std::min(radius, length);
    }
  }
  return ConstrainedMaximum{x, here.value};
}

}  // namespace stablecut::numerics
