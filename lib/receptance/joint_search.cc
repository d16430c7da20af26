#include "receptance/joint_search.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>

namespace stablecut::receptance {
namespace {

using Complex = std::complex<double>;

constexpr Eigen::Index kTrialLines = 800;  // lines on which all starts are tried
constexpr int kTrialSteps = 15;            // steps on them
constexpr std::size_t kFinalists = 3;      // starts that are carried on to the end, on all lines
constexpr int kFinalSteps = 200;           // steps on all lines
constexpr int kBoundRounds = 8;            // sets of values held at their bounds
constexpr double kBoundShare = 1e-9;  // distance in the solver's coordinates at which a value is at its bound
constexpr double kShareFloor = 0.01;  // of 1 / weight: what |measured| counts at least in weights by share
constexpr double kDampingShare = 1e-3;    // of k / w: dampings below it are told apart by their difference
constexpr double kCostTolerance = 1e-15;  // relative decrease of the objective that ends a search
constexpr double kStepTolerance = 1e-14;  // relative step that ends a search

// The solver's coordinates u: log k, and log (c + s), which can pass through c = 0, with s = kDampingShare k
// / w.
class LogJoint {
 public:
  LogJoint(const ToolJoint& near, double omega)
      : offset_{0, kDampingShare * near.k1 / omega, 0, kDampingShare * near.k2 / omega} {}
  double to(std::size_t i, double value) const { return std::log(value + offset_[i]); }
  double from(std::size_t i, double u) const { return std::exp(u) - offset_[i]; }
  // d value / du.
  double slope(std::size_t i, double value) const { return value + offset_[i]; }

 private:
  JointValues offset_;
};

class TipCost : public ceres::CostFunction {
 public:
  TipCost(const TipLines& lines, const LogJoint& coordinates, JointObjective objective)
      : lines_(lines), coordinates_(coordinates), objective_(objective) {
    set_num_residuals(static_cast<int>(2 * lines.size()));
    mutable_parameter_block_sizes()->push_back(4);
  }

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    JointValues values;
    for (std::size_t i = 0; i < 4; ++i) values[i] = std::max(0.0, coordinates_.from(i, parameters[0][i]));
    const ToolJoint joint = joint_of(values);
    for (std::size_t n = 0; n < lines_.size(); ++n) {
      const Tip tip = tip_of(lines_[n], joint);
      Complex residual;
      if (!std::isfinite(residual_of(lines_[n], tip, objective_, residual))) return false;
      residuals[2 * n] = residual.real();
      residuals[2 * n + 1] = residual.imag();
      if (jacobians == nullptr || jacobians[0] == nullptr) continue;
      const Eigen::Matrix<double, 2, 4> by = residual_derivatives(lines_[n], tip, objective_);
      for (std::size_t i = 0; i < 4; ++i) {
        const double slope = coordinates_.slope(i, values[i]);
        jacobians[0][8 * n + i] = slope * by(0, i);
        jacobians[0][8 * n + 4 + i] = slope * by(1, i);
      }
    }
    return true;
  }

 private:
  const TipLines& lines_;
  const LogJoint& coordinates_;
  JointObjective objective_;
};

ceres::Solver::Options solver_options(int most_steps) {
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = most_steps;
  options.function_tolerance = kCostTolerance;
  options.gradient_tolerance = 0;
  options.parameter_tolerance = kStepTolerance;
  // A step that crosses a bound is cut there or, if that does not descend, made shorter; without a line
  // search.
  options.max_num_line_search_step_size_iterations = 0;
  options.logging_type = ceres::SILENT;
  options.num_threads = 1;
  return options;
}

// The solver's coordinates and their bounds.
struct BoundedCoordinates {
  std::array<double, 4> u{}, least{}, most{};

  bool at_least(std::size_t i) const { return u[i] - least[i] < kBoundShare; }
  bool at_most(std::size_t i) const { return most[i] - u[i] < kBoundShare; }

  // Those at a bound that the objective's slope pushes them against.
  std::vector<int> held_back(const std::vector<double>& slope) const {
    std::vector<int> held;
    for (int i = 0; i < 4; ++i) {
      const std::size_t at = i;
      if ((at_least(at) && slope[at] > 0) || (at_most(at) && slope[at] < 0)) held.push_back(i);
    }
    return held;
  }
};

}  // namespace

Eigen::Matrix<double, 2, 4> residual_derivatives(const TipLine& line, const Tip& tip,
                                                 JointObjective objective) {
  std::array<Complex, 4> by = {tip.by_k1, Complex(0, line.omega) * tip.by_k1, tip.by_k2,
                               Complex(0, line.omega) * tip.by_k2};
  Eigen::Matrix<double, 2, 4> result;
  for (std::size_t i = 0; i < 4; ++i) {
    // d |h| = Re(conj(h) dh) / |h|.
    if (objective == JointObjective::kAmplitude) by[i] = (std::conj(tip.h) * by[i]).real() / std::abs(tip.h);
    result.col(i) << line.weight * by[i].real(), line.weight * by[i].imag();
  }
  return result;
}

JointCandidate refined_joint(const TipLines& lines, const ToolJoint& start, const JointBounds& bounds,
                             JointObjective objective, int most_steps) {
  const LogJoint coordinates(start, middle_omega(lines));
  const JointValues first = values_of(clamped(start, bounds));
  BoundedCoordinates at;
  for (std::size_t i = 0; i < 4; ++i) {
    at.least[i] = coordinates.to(i, bounds.least[i]);
    at.most[i] = coordinates.to(i, bounds.most[i]);
    at.u[i] = std::clamp(coordinates.to(i, first[i]), at.least[i], at.most[i]);
  }
  // Ceres projects a step onto the bounds, and such a step need not descend. Values that are held back at
  // their bounds are therefore taken out of the problem, until the set of them no longer changes (README.md,
  // section 13).
  const ceres::Solver::Options options = solver_options(most_steps);
  std::vector<int> held;
  for (int round = 0; round < kBoundRounds; ++round) {
    ceres::Problem problem;
    problem.AddResidualBlock(new TipCost(lines, coordinates, objective), nullptr, at.u.data());
    std::vector<double> slope(4);
    problem.Evaluate({}, nullptr, nullptr, &slope, nullptr);
    for (int i = 0; i < 4; ++i) {
      problem.SetParameterLowerBound(at.u.data(), i, at.least[static_cast<std::size_t>(i)]);
      problem.SetParameterUpperBound(at.u.data(), i, at.most[static_cast<std::size_t>(i)]);
    }
    const std::vector<int> holding = at.held_back(slope);
    if (holding.size() == 4 || (round > 0 && holding == held)) break;
    held = holding;
    if (!held.empty()) problem.SetManifold(at.u.data(), new ceres::SubsetManifold(4, held));
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
  }
  JointValues values;
  for (std::size_t i = 0; i < 4; ++i) {
    values[i] = std::clamp(coordinates.from(i, at.u[i]), bounds.least[i], bounds.most[i]);
    if (at.at_least(i)) values[i] = bounds.least[i];
    if (at.at_most(i)) values[i] = bounds.most[i];
  }
  const ToolJoint joint = joint_of(values);
  return {joint, cost_of(lines, joint, objective)};
}

JointCandidate converged_joint(const TipLines& lines, const ToolJoint& start, const JointBounds& bounds,
                               JointObjective objective) {
  return refined_joint(lines, start, bounds, objective, kFinalSteps);
}

JointCandidate best_joint(const TipLines& lines, const JointBounds& bounds, JointObjective objective) {
  std::vector<JointCandidate> trials = joint_starts(lines, bounds, objective);
  // A few lines on sharp peaks may outweigh all others: starts are also looked for with every line weighted
  // by the inverse of its modulus.
  TipLines by_share = lines;
  for (TipLine& line : by_share)
    line.weight = 1 / std::max(std::abs(line.measured), kShareFloor / line.weight);
  for (const JointCandidate& start : joint_starts(by_share, bounds, objective)) trials.push_back(start);
  const TipLines few = thinned(lines, kTrialLines);
  for (JointCandidate& trial : trials)
    trial = refined_joint(few, trial.joint, bounds, objective, kTrialSteps);
  trials = best_distinct(std::move(trials), kFinalists);
  for (JointCandidate& trial : trials) trial = converged_joint(lines, trial.joint, bounds, objective);
  return best_distinct(std::move(trials), 1).front();
}

}  // namespace stablecut::receptance
