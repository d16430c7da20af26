#include "modal/maximum_likelihood.h"

#include <ceres/ceres.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "modal/likelihood.h"
#include "modal/pole_sums.h"
#include "modal/residual_sums.h"

namespace stablecut::modal {
namespace {

using Complex = std::complex<double>;

// Bounds, kept as Ceres does [Kanzow2004]: of -Re lambda / Im lambda, and of Im lambda over the highest line.
// A mode far above the band looks nearly the same from three times the band on, and a high frequency costs
// time in a stability chart.
constexpr double kLeastRatio = 1e-6, kLargestRatio = 20;
constexpr double kLeastRate = 1e-5, kLargestRate = 3;
constexpr double kStepTolerance = 1e-13;  // relative size of a step that ends a refinement
// A refinement that was stopped has settled when the last steps brought a smaller share than that of the
// cost.
constexpr std::size_t kLastSteps = 20;
constexpr double kNextToNothing = 1e-3;
constexpr std::size_t kPatience = 240;  // steps after which one that has settled ends

// Least squares depend on the residual r of all lines and its Jacobian J only through J^T J, J^T r and |r|^2.
// So the solver gets a short equivalent: with U^T U = J^T J the residual (U^-T J^T r, rest) and the Jacobian
// (U, 0).
class CompressedCost : public ceres::CostFunction {
 public:
  explicit CompressedCost(const Likelihood& likelihood, Eigen::Index size)
      : likelihood_(likelihood), size_(size) {
    set_num_residuals(static_cast<int>(size + 1));
    mutable_parameter_block_sizes()->push_back(static_cast<int>(size));
  }

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    Eigen::Map<Eigen::VectorXd> residual(residuals, size_ + 1);
    const bool with_jacobian = jacobians != nullptr && jacobians[0] != nullptr;
    const NormalEquations normal =
        likelihood_.evaluate(Eigen::Map<const Eigen::VectorXd>(parameters[0], size_), with_jacobian);
    if (!std::isfinite(normal.chi_square)) return false;
    residual.setZero();
    if (with_jacobian) {
      const Eigen::MatrixXd upper = upper_factor(normal);
      residual.head(size_) = upper.transpose().triangularView<Eigen::Lower>().solve(normal.gradient);
      Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> jacobian(
          jacobians[0], size_ + 1, size_);
      jacobian.setZero();
      jacobian.topRows(size_) = upper;
    }
    residual[size_] = std::sqrt(std::max(0.0, normal.chi_square - residual.head(size_).squaredNorm()));
    return true;
  }

 private:
  const Likelihood& likelihood_;
  Eigen::Index size_;
};

Eigen::VectorXd removal_loss(const ModeParameters& parameters, const Eigen::VectorXd& x,
                             const NormalEquations& normal) {
  const Eigen::MatrixXd covariance = inverse_normal_matrix(normal);
  Eigen::VectorXd loss(parameters.modes());
  for (Eigen::Index k = 0; k < loss.size(); ++k) {
    const Eigen::VectorXd change = parameters.removal(x, k);
    const Eigen::Index first = parameters.pole_at(k) + parameters.per_mode() - change.size();
    loss[k] = change.dot(
        Eigen::MatrixXd(covariance.block(first, first, change.size(), change.size())).llt().solve(change));
  }
  return loss;
}

// Ends a refinement that has settled without having converged in a usual number of steps.
class Patience : public ceres::IterationCallback {
 public:
  ceres::CallbackReturnType operator()(const ceres::IterationSummary& step) override {
    costs_.push_back(step.cost);
    return costs_.size() > kPatience && settled() ? ceres::SOLVER_TERMINATE_SUCCESSFULLY
                                                  : ceres::SOLVER_CONTINUE;
  }
  // The last steps brought next to nothing, along something that the curves hardly see.
  bool settled() const {
    return costs_.size() > kLastSteps &&
           costs_[costs_.size() - 1 - kLastSteps] - costs_.back() < kNextToNothing * costs_.back();
  }

 private:
  std::vector<double> costs_;  // of the steps so far
};

}  // namespace

RefinedModes refine_modes(const FitData& data, const std::vector<dynamics::Mode>& start, ModeModel model,
                          const Effort& effort) {
  RefinedModes result;
  if (start.empty()) {
    result.chi_square = chi_square_of(data, start);
    result.converged = true;
    return result;
  }
  const ModeParameters parameters(start, data.dofs, model);
  const Likelihood likelihood(data, parameters, out_of_band(data, start));
  Eigen::VectorXd x = parameters.pack(start);
  ceres::Problem problem;
  problem.AddResidualBlock(new CompressedCost(likelihood, parameters.size()), nullptr, x.data());
  const double highest = data.s.cwiseAbs().maxCoeff();
  for (Eigen::Index k = 0; k < parameters.modes() && !data.poles_fixed; ++k) {
    const auto bound = [&](Eigen::Index at, double least, double most) {
      x[at] = std::clamp(x[at], std::log(least), std::log(most));
      problem.SetParameterLowerBound(x.data(), static_cast<int>(at), std::log(least));
      problem.SetParameterUpperBound(x.data(), static_cast<int>(at), std::log(most));
    };
    bound(parameters.pole_at(k), kLeastRatio, kLargestRatio);
    bound(parameters.pole_at(k) + 1, kLeastRate * highest, kLargestRate * highest);
  }
  const double complex_values = data.values() / 2;
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
  options.max_num_iterations = effort.iterations;
  options.function_tolerance = effort.tolerance / complex_values;
  options.gradient_tolerance = 0;
  options.parameter_tolerance = kStepTolerance;
  options.max_num_line_search_step_size_iterations = 0;  // a step that meets a bound is cut there
  options.logging_type = ceres::SILENT;
  options.num_threads = 1;
  Patience patience;
  options.callbacks.push_back(&patience);
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);

  result.modes = parameters.unpack(x);
  for (std::size_t k = 0; k < start.size(); ++k) result.modes[k].out_of_band = start[k].out_of_band;
  result.converged =
      summary.termination_type == ceres::CONVERGENCE || (summary.IsSolutionUsable() && patience.settled());
  const NormalEquations normal = likelihood.evaluate(x, true);
  result.chi_square = normal.chi_square;
  result.removal_loss = removal_loss(parameters, x, normal);
  return result;
}

Eigen::VectorXcd curve_of(const std::vector<dynamics::Mode>& modes, const Curve& curve,
                          const Eigen::VectorXcd& s) {
  Eigen::VectorXcd h = Eigen::VectorXcd::Zero(s.size());
  for (const dynamics::Mode& mode : modes)
    add_pole_pair(s, mode.pole(), mode.psi_r[curve.response] * mode.psi_l[curve.reference], h);
  return h;
}

double chi_square_of(const FitData& data, const std::vector<dynamics::Mode>& modes) {
  Eigen::VectorXcd poles(modes.size());
  Eigen::MatrixXcd residue(modes.size(), data.curves.size());
  for (Eigen::Index k = 0; k < poles.size(); ++k) {
    const dynamics::Mode& mode = modes[k];
    poles[k] = mode.pole();
    for (Eigen::Index c = 0; c < residue.cols(); ++c)
      residue(k, c) = mode.psi_r[data.curves[c].response] * mode.psi_l[data.curves[c].reference];
  }
  return ResidualSums(data).evaluate(poles, residue, nullptr);
}

}  // namespace stablecut::modal
