#include "robot/identification.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "numerics/distributions.h"
#include "robot/least_squares.h"

namespace stablecut::robot {
namespace {

constexpr double kQuantile = 0.975;      // of the two-sided 95 % interval
constexpr double kContradiction = 1e-3;  // chi-square tail below which stated deviations are too small

JointVerdict verdict_before_fit(Visibility visibility) {
  switch (visibility) {
    case Visibility::kVisible:
      return JointVerdict::kIdentified;
    case Visibility::kUnseen:
      return JointVerdict::kUnseen;
    case Visibility::kInseparable:
      break;
  }
  return JointVerdict::kInseparable;
}

// Judges the residuals, and returns the variance of a row whose `std` is 1. With the robust loss a sample
// counts by its influence w z.
double row_variance(const ComplianceFit& fit, Identification& result) {
  const double freedom = static_cast<double>(fit.a.rows() - fit.a.cols());
  const Eigen::VectorXd z = fit.residual.cwiseQuotient(fit.std);
  const double influence = fit.weight.cwiseProduct(z).squaredNorm();
  if (!fit.deviations_stated) {
    if (!(freedom > 0)) return 1;
    result.degrees_of_freedom = freedom;
    result.deviations_known = true;
    return influence / freedom;
  }
  result.degrees_of_freedom = std::numeric_limits<double>::infinity();
  result.deviations_known = true;
  if (!(freedom > 0)) return 1;
  result.chi_square_per_dof = influence / freedom;
  result.chi_square_tail = numerics::chi_square_tail(influence, freedom);
  result.deviations_contradicted = result.chi_square_tail < kContradiction;
  if (!result.deviations_contradicted) return 1;
  result.degrees_of_freedom = freedom;
  return influence / freedom;
}

// Compliances, covariance (Huber's asymptotic one where the loss is robust [Huber2009]) and intervals.
void estimate(const ComplianceFit& fit, Identification& result) {
  const double variance = row_variance(fit, result);
  const Eigen::MatrixXd covariance = variance / std::pow(fit.mean_influence_slope(), 2) *
                                     inverse_normal_matrix(fit.std.cwiseInverse().asDiagonal() * fit.a);
  const auto visible = [&](int joint) { return fit.seen.visibility[joint] == Visibility::kVisible; };
  const std::vector<int>& joints = fit.seen.independent;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    result.compliance[joints[i]] = fit.solution[i];
    for (std::size_t k = 0; k < joints.size(); ++k) {
      if (visible(joints[i]) && visible(joints[k]))
        result.covariance(joints[i], joints[k]) = covariance(i, k);
    }
  }
  for (int joint = 0; joint < kJoints; ++joint) {
    if (!result.identified(joint)) {
      result.compliance[joint] = 0;
      continue;
    }
    double half = 0;
    if (result.deviations_known) {
      half = numerics::student_t_quantile(kQuantile, result.degrees_of_freedom) *
             std::sqrt(result.covariance(joint, joint));
      result.low[joint] = result.compliance[joint] - half;
      result.high[joint] = result.compliance[joint] + half;
    }
    if (!(result.compliance[joint] > half)) result.verdict[joint] = JointVerdict::kUncertain;
  }
}

void residual_sizes(const ComplianceFit& fit, Identification& result) {
  double sum[2] = {0, 0};
  int count[2] = {0, 0};
  for (Eigen::Index i = 0; i < fit.residual.size(); ++i) {
    const bool rotation = fit.equations.rotation[i];
    sum[rotation] += fit.residual[i] * fit.residual[i];
    ++count[rotation];
  }
  if (count[0] > 0) result.residual_rms_m = std::sqrt(sum[0] / count[0]);
  if (count[1] > 0) result.residual_rms_rad = std::sqrt(sum[1] / count[1]);
}

bool moved_against_loads(const std::vector<LoadSample>& samples) {
  double work = 0;
  for (const LoadSample& sample : samples) {
    if (sample.force_point == sample.measuring_point) work += sample.force_n.dot(sample.deflection_m);
  }
  return work < 0;
}

}  // namespace

bool Identification::any_identified() const {
  return std::find(verdict.begin(), verdict.end(), JointVerdict::kIdentified) != verdict.end();
}

Identification identify_stiffness(const Robot& robot, const std::vector<LoadSample>& samples,
                                  const IdentificationOptions& options) {
  const ComplianceEquations equations = compliance_equations(robot, samples, options.components);
  const ComplianceFit fit = fit_compliances(equations, options.huber);
  Identification result;
  result.moved_against_loads = moved_against_loads(samples);
  result.rank = fit.seen.rank;
  result.low.fill(std::numeric_limits<double>::quiet_NaN());
  result.high = result.low;
  for (int j = 0; j < kJoints; ++j) result.verdict[j] = verdict_before_fit(fit.seen.visibility[j]);
  if (fit.a.cols() == 0) return result;
  // With the deviations that rotations have settled to.
  result.condition_number = identifiability(fit.std.cwiseInverse().asDiagonal() * equations.a,
                                            fit.std.cwiseInverse().asDiagonal() * equations.largest)
                                .condition_number;
  estimate(fit, result);
  residual_sizes(fit, result);
  result.cross_validation = cross_validation(fit);
  if (result.deviations_known) {
    const bool agreed = fit.deviations_stated && !result.deviations_contradicted;
    result.outliers = outliers(fit, {options.huber, agreed});
  }
  return result;
}

}  // namespace stablecut::robot
