#include "numerics/constrained_maximum.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
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
constexpr int kDifferenceTrials = 4;      // steps, each a tenth of the one before, until one stays inside
constexpr double kLeastCurvature = 1e-8;  // of the largest, that the model bends downwards everywhere
constexpr double kNearConstraint = 1.5;   // trust regions within which a constraint can matter
constexpr double kMultiplierRounding = 1e-12, kSlackRounding = 1e-9, kLeastBound = 1e-6;
// A step is good when it keeps this share of what the model promised, poor below the other; how much the
// trust region grows, shrinks, and shrinks where the step was in vain.
constexpr double kGood = 0.5, kPoor = 0.1, kGrowth = 2, kShrink = 0.5, kShrinkInVain = 0.3;

using Matrix = Eigen::MatrixXd;

// Directions of length 1 at right angles [variables x variables]: the first `across` leave what holds the
// point (constraints and bounds that push against it), the others lead along it.
struct Frame {
  Matrix axes;
  Eigen::Index across = 0;
};

// From the gradients of what holds the point, as columns.
Frame frame_across(const Matrix& holding) {
  const Eigen::Index n = holding.rows();
  if (holding.cols() == 0) return {Matrix::Identity(n, n), 0};
  const Eigen::ColPivHouseholderQR<Matrix> factors(holding.colwise().normalized());
  return {factors.householderQ() * Matrix::Identity(n, n), factors.rank()};
}

// First and second derivatives of the value and of each constraint.
struct Derivatives {
  Variables gradient;
  Matrix hessian;
  Eigen::MatrixXd constraint_gradient;  // [constraints x variables]
  std::vector<Matrix> constraint_hessian;
};

// By differences along the axes. Across a constraint the function may bend a million times as much as along
// it, so that differences askew to it would see nothing of the rest.
std::optional<Derivatives> differences_at(const ConstrainedFunction& function, const Variables& x,
                                          const ConstrainedValue& here, double h, const Matrix& axes) {
  const Eigen::Index n = x.size(), m = here.constraints.size();
  Derivatives d{Variables::Zero(n), Matrix::Zero(n, n), Eigen::MatrixXd::Zero(m, n),
                std::vector<Matrix>(m, Matrix::Zero(n, n))};
  const auto moved = [&](Eigen::Index i, double a, Eigen::Index j, double b) {
    return function(x + h * (a * axes.col(i) + b * axes.col(j)));
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
  d.gradient = axes * d.gradient;
  d.hessian = axes * d.hessian * axes.transpose();
  d.constraint_gradient *= axes.transpose();
  for (Matrix& hessian : d.constraint_hessian) hessian = axes * hessian * axes.transpose();
  return d;
}

// The same with smaller steps where the function ends within one.
std::optional<Derivatives> derivatives_at(const ConstrainedFunction& function, const Variables& x,
                                          const ConstrainedValue& here, double h, const Matrix& axes) {
  for (int i = 0; i < kDifferenceTrials; ++i, h /= 10) {
    if (auto d = differences_at(function, x, here, h, axes)) return d;
  }
  return std::nullopt;
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

// Only along what holds the point: across, the constraint decides how far a step goes.
Matrix concave_along(const Matrix& hessian, const Frame& frame) {
  if (frame.across == 0) return concave(hessian);
  const Eigen::Index along = hessian.rows() - frame.across;
  Matrix inside = Matrix::Zero(hessian.rows(), hessian.rows());
  inside.diagonal().head(frame.across).setConstant(-kLeastCurvature);
  if (along > 0) {
    const Matrix axes = frame.axes.rightCols(along);
    inside.bottomRightCorner(along, along) = concave(axes.transpose() * hessian * axes);
  }
  return frame.axes * inside * frame.axes.transpose();
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

// The step of least length with rows step = missing that stays inside from..to: variables that it would take
// out stop there, and the others make up for them as far as they can.
Variables least_step(const Eigen::MatrixXd& rows, const Eigen::VectorXd& missing, const Variables& from,
                     const Variables& to) {
  Variables step = Variables::Zero(from.size());
  Eigen::MatrixXd free_rows = rows;
  Eigen::VectorXd left = missing;
  for (Eigen::Index round = 0; round < from.size(); ++round) {
    const Variables wanted = free_rows.completeOrthogonalDecomposition().solve(left);
    bool stopped = false;
    for (Eigen::Index i = 0; i < from.size(); ++i) {
      if (free_rows.col(i).isZero(0)) continue;
      step[i] = std::clamp(wanted[i], from[i], to[i]);
      if (step[i] == wanted[i]) continue;
      stopped = true;
      left -= step[i] * free_rows.col(i);
      free_rows.col(i).setZero();
    }
    if (!stopped) break;
  }
  return step;
}

// Draws a point back to where every constraint holds, by steps of least length along the gradients in
// `slopes`. What a step has broken once is held from then on.
std::optional<ConstrainedMaximum> drawn_back(const ConstrainedFunction& function, Variables x,
                                             const Eigen::MatrixXd& slopes, const Variables& lower,
                                             const Variables& upper) {
  x = x.cwiseMax(lower).cwiseMin(upper);
  std::vector<bool> held(static_cast<std::size_t>(slopes.rows()), false);
  for (int i = 0; i <= kMostCorrections; ++i) {
    const auto at = function(x);
    if (!at) return std::nullopt;
    if (allowed(*at)) return ConstrainedMaximum{x, at->value};
    std::vector<Eigen::Index> rows;
    for (Eigen::Index k = 0; k < at->constraints.size(); ++k) {
      if (at->constraints[k] < 0) held[k] = true;
      if (held[k]) rows.push_back(k);
    }
    Eigen::VectorXd missing(rows.size());
    for (std::size_t k = 0; k < rows.size(); ++k) missing[k] = kInside - at->constraints[rows[k]];
    x += least_step(slopes(rows, Eigen::all), missing, lower - x, upper - x);
  }
  return std::nullopt;
}

// The end of a step, moved to where the constraints' second-order model holds: beyond a constraint the
// function may be undefined, with no way back.
Variables bent_end(const Variables& x, const Variables& step, const ConstrainedValue& here,
                   const Derivatives& d, const Variables& lower, const Variables& upper) {
  const Variables end = x + step;
  Eigen::VectorXd missing = Eigen::VectorXd::Zero(here.constraints.size());
  Eigen::MatrixXd slopes = d.constraint_gradient;
  for (Eigen::Index k = 0; k < missing.size(); ++k) {
    const double there =
        here.constraints[k] + slopes.row(k).dot(step) + 0.5 * step.dot(d.constraint_hessian[k] * step);
    if (there < 0)
      missing[k] = kInside - there;
    else
      slopes.row(k).setZero();
  }
  return slopes.isZero(0) ? end : Variables(end + least_step(slopes, missing, lower - end, upper - end));
}

// From a point that is not allowed to one that is, by Gauss-Newton steps on what is violated.
std::optional<Variables> allowed_point(const ConstrainedFunction& function, Variables x,
                                       const Variables& lower, const Variables& upper, double difference) {
  for (int i = 0; i < kMostRestorations; ++i) {
    const auto at = function(x);
    if (!at) return std::nullopt;
    if (allowed(*at)) return x;
    const auto d = derivatives_at(function, x, *at, difference, Matrix::Identity(x.size(), x.size()));
    if (!d) return std::nullopt;
    if (const auto found = drawn_back(function, x, d->constraint_gradient, lower, upper)) return found->point;
    const Eigen::VectorXd missing = (kInside - at->constraints.array()).max(0.0);
    Eigen::MatrixXd a = d->constraint_gradient;
    for (Eigen::Index k = 0; k < missing.size(); ++k) {
      if (missing[k] <= kInside) a.row(k).setZero();
    }
    Variables step = least_step(a, missing, lower - x, upper - x);
    const double size = step.cwiseAbs().maxCoeff();
    if (size > kLargestRestoration) step *= kLargestRestoration / size;
    x = (x + step).cwiseMax(lower).cwiseMin(upper);
  }
  return std::nullopt;
}

// rows d >= bounds for a step d: first the constraints `near` that can matter within the trust region, then
// the region's own box, cut by lower and upper (two rows a variable).
struct LinearBounds {
  std::vector<Eigen::Index> near;
  Eigen::MatrixXd rows;
  Eigen::VectorXd bounds;
};

LinearBounds bounds_around(const Variables& x, const ConstrainedValue& here, const Derivatives& d,
                           const Variables& lower, const Variables& upper, double radius) {
  const Eigen::Index n = x.size();
  LinearBounds result;
  for (Eigen::Index k = 0; k < here.constraints.size(); ++k) {
    if (here.constraints[k] < kNearConstraint * radius * d.constraint_gradient.row(k).lpNorm<1>())
      result.near.push_back(k);
  }
  const Eigen::Index constraints = static_cast<Eigen::Index>(result.near.size());
  result.rows = Eigen::MatrixXd::Zero(constraints + 2 * n, n);
  result.bounds.resize(constraints + 2 * n);
  for (Eigen::Index k = 0; k < constraints; ++k) {
    result.rows.row(k) = d.constraint_gradient.row(result.near[k]);
    result.bounds[k] = kInside - here.constraints[result.near[k]];
  }
  for (Eigen::Index i = 0; i < n; ++i) {
    result.rows(constraints + 2 * i, i) = 1;
    result.bounds[constraints + 2 * i] = std::max(-radius, lower[i] - x[i]);
    result.rows(constraints + 2 * i + 1, i) = -1;
    result.bounds[constraints + 2 * i + 1] = -std::min(radius, upper[i] - x[i]);
  }
  return result;
}

// The frame of what pushes against a step to `x`: constraints, whose gradients at the step's begin turn by
// their second derivatives, and lower and upper. The trust region's own box does not count.
Frame frame_at(const Variables& x, const QuadraticStep& step, const Variables& moved,
               const LinearBounds& around, const Derivatives& d, const Variables& lower,
               const Variables& upper) {
  const Eigen::Index n = x.size(), constraints = static_cast<Eigen::Index>(around.near.size());
  Matrix holding(n, step.multipliers.size());
  Eigen::Index count = 0;
  for (Eigen::Index k = 0; k < step.multipliers.size(); ++k) {
    if (!(step.multipliers[k] > 0)) continue;
    const Eigen::Index i = (k - constraints) / 2;
    if (k < constraints) {
      const Eigen::Index c = around.near[k];
      holding.col(count++) = d.constraint_gradient.row(c).transpose() + d.constraint_hessian[c] * moved;
    } else if (x[i] == lower[i] || x[i] == upper[i]) {
      holding.col(count++) = Variables::Unit(n, i);
    }
  }
  return frame_across(holding.leftCols(count));
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
  Frame frame = frame_across(Matrix(n, 0));
  bool framed_here = false;
  for (int count = 0; count < kMostSteps && radius > kLeastRadius; ++count) {
    // On a ridge that is narrow the trust region is small, and the differences with it.
    if (!d) {
      const double h = std::clamp(kDifferenceShare * radius, kLeastDifference * difference, difference);
      d = derivatives_at(function, x, here, h, frame.axes);
    }
    if (!d) break;
    Matrix lagrangian = d->hessian;
    for (Eigen::Index k = 0; k < m; ++k) lagrangian += multipliers[k] * d->constraint_hessian[k];
    const Matrix model = concave_along(lagrangian, frame);
    const LinearBounds around = bounds_around(x, here, *d, lower, upper, radius);
    const auto step = QuadraticProgram(d->gradient, model, around.rows, around.bounds).solve();
    if (!step) {
      radius *= kShrink;
      continue;
    }
    const double length = step->step.cwiseAbs().maxCoeff();
    const auto candidate = drawn_back(function, bent_end(x, step->step, here, *d, lower, upper),
                                      d->constraint_gradient, lower, upper);
    if (candidate && candidate->value > here.value) {
      const double promised = d->gradient.dot(step->step) + 0.5 * step->step.dot(model * step->step);
      const double kept = candidate->value - here.value;
      if (kept > kGood * promised && length > radius / 2) radius = std::min(kGrowth * radius, kLargestRadius);
      if (kept < kPoor * promised) radius *= kShrink;
      const Variables moved = candidate->point - x;
      x = candidate->point;
      here = *function(x);
      multipliers.setZero();
      const Eigen::Index constraints = static_cast<Eigen::Index>(around.near.size());
      for (Eigen::Index k = 0; k < constraints; ++k) multipliers[around.near[k]] = step->multipliers[k];
      frame = frame_at(x, *step, moved, around, *d, lower, upper);
      framed_here = false;
      d.reset();
    } else {
      // Where the frame came from a point before, what pushes here may lie askew to it.
      if (!framed_here) {
        frame = frame_at(x, *step, Variables::Zero(n), around, *d, lower, upper);
        framed_here = true;
        d.reset();
      }
      radius = kShrinkInVain * std::min(radius, length);
    }
  }
  return ConstrainedMaximum{x, here.value};
}

}  // namespace stablecut::numerics
