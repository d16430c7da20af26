#include "robot/identification.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "numerics/distributions.h"
#include "robot/least_squares.h"
#include "robot/left_out.h"

namespace stablecut::robot {
namespace {

constexpr double kQuantile = 0.975;      // of the two-sided 95 % interval
constexpr double kContradiction = 1e-3;  // tail below which the residuals are more than noise
constexpr double kSameLoad = 0.01;       // of the largest load: repeats of a load differ by less

Verdict verdict_before_fit(Visibility visibility) {
  switch (visibility) {
    case Visibility::kVisible:
      return Verdict::kIdentified;
    case Visibility::kUnseen:
      return Verdict::kUnseen;
    case Visibility::kInseparable:
      break;
  }
  return Verdict::kInseparable;
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

// Whether rows of equal pose and load scatter less than the poses differ from the model: the residuals then
// hold an error that repeating does not average. [Draper1998, 2.1]
bool repeats_agree_too_well(const ComplianceFit& fit, const std::vector<LoadSample>& samples,
                            const SampleGroups& poses) {
  std::map<std::array<long long, 8>, std::vector<const SampleRows*>> repeats;
  double largest = 0;
  for (const LoadSample& sample : samples) largest = std::max(largest, sample.force_n.norm());
  for (const SampleRows& rows : fit.samples) {
    const LoadSample& sample = samples[rows.sample];
    std::array<long long, 8> key = {poses.of_sample[rows.sample], rows.count};
    for (int d = 0; d < 3; ++d) {
      key[2 + d] = std::llround(sample.force_n[d] / (kSameLoad * largest));
      key[5 + d] = std::llround(sample.moment_n_m[d] / (kSameLoad * largest));
    }
    repeats[key].push_back(&rows);
  }
  const Eigen::VectorXd z = fit.whitening().cwiseProduct(fit.residual);
  double within = 0, within_freedom = 0;
  for (const auto& [key, group] : repeats) {
    Eigen::VectorXd mean = Eigen::VectorXd::Zero(group.front()->count);
    for (const SampleRows* rows : group)
      mean += z.segment(rows->first, rows->count) / static_cast<double>(group.size());
    for (const SampleRows* rows : group) within += (z.segment(rows->first, rows->count) - mean).squaredNorm();
    within_freedom += static_cast<double>((group.size() - 1) * mean.size());
  }
  const double between_freedom = static_cast<double>(z.size() - fit.a.cols()) - within_freedom;
  if (!(within_freedom > 0) || !(between_freedom > 0)) return false;
  const double between = std::max(0.0, z.squaredNorm() - within) / between_freedom;
  return numerics::f_tail(between / (within / within_freedom), between_freedom, within_freedom) <
         kContradiction;
}

// Covariance of the fit's columns: from the rows where residuals are noise (Huber's asymptotic one where the
// loss is robust [Huber2009]), else from the scatter between poses.
Eigen::MatrixXd covariance_of(const ComplianceFit& fit, const LeftOut& by_pose, int poses, double variance,
                              Identification& result) {
  const double freedom = static_cast<double>(poses - fit.a.cols());
  if (result.model_error && freedom >= 1) {
    result.degrees_of_freedom = freedom;
    return by_pose.jackknife;
  }
  return variance / std::pow(fit.mean_influence_slope(), 2) *
         inverse_normal_matrix(fit.std.cwiseInverse().asDiagonal() * fit.a);
}

// Compliances, their covariance and intervals.
void estimate(const ComplianceFit& fit, const Eigen::MatrixXd& covariance, Identification& result) {
  const auto visible = [&](int spring) { return fit.seen.visibility[spring] == Visibility::kVisible; };
  const std::vector<int>& springs = fit.seen.independent;
  for (std::size_t i = 0; i < springs.size(); ++i) {
    if (!visible(springs[i])) continue;
    result.compliance[springs[i]] = fit.solution[i];
    for (std::size_t k = 0; k < springs.size(); ++k) {
      if (visible(springs[k])) result.covariance(springs[i], springs[k]) = covariance(i, k);
    }
  }
  for (std::size_t spring = 0; spring < result.springs.size(); ++spring) {
    if (result.verdict[spring] != Verdict::kIdentified) continue;
    double half = 0;
    if (result.deviations_known) {
      half = numerics::student_t_quantile(kQuantile, result.degrees_of_freedom) *
             std::sqrt(result.covariance(spring, spring));
      result.low[spring] = result.compliance[spring] - half;
      result.high[spring] = result.compliance[spring] + half;
    }
    if (!(result.compliance[spring] > half)) result.verdict[spring] = Verdict::kUncertain;
  }
}

void residual_sizes(const ComplianceFit& fit, Identification& result) {
  double sum[2] = {0, 0}, measured = 0;
  int count[2] = {0, 0};
  for (Eigen::Index i = 0; i < fit.residual.size(); ++i) {
    const bool rotation = fit.equations.rotation[i];
    sum[rotation] += fit.residual[i] * fit.residual[i];
    ++count[rotation];
    if (!rotation) measured += fit.equations.b[i] * fit.equations.b[i];
  }
  if (count[0] > 0) result.deflection_rms_m = std::sqrt(measured / count[0]);
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
  return std::find(verdict.begin(), verdict.end(), Verdict::kIdentified) != verdict.end();
}

Identification identify_stiffness(const Robot& robot, const std::vector<LoadSample>& samples,
                                  const IdentificationOptions& options) {
  const SampleGroups poses = groups_by_pose(samples), blocks = groups_by_block(samples, poses);
  const ComplianceEquations all =
      compliance_equations(robot, springs_of(robot, ElasticModel::kThreeAxis), samples, options.components);
  Identification result;
  result.moved_against_loads = moved_against_loads(samples);
  result.models = compare_models(robot, all, blocks);
  result.model = options.model.value_or(result.models.best);
  result.springs = springs_of(robot, result.model);
  const ComplianceEquations equations = with_springs(all, result.springs);
  const ComplianceFit fit = fit_compliances(equations, options.huber);
  const Eigen::Index n = result.springs.size();
  result.compliance = Eigen::VectorXd::Zero(n);
  result.covariance = Eigen::MatrixXd::Zero(n, n);
  result.rank = fit.seen.rank;
  result.low.assign(n, std::numeric_limits<double>::quiet_NaN());
  result.high = result.low;
  for (const Visibility visibility : fit.seen.visibility)
    result.verdict.push_back(verdict_before_fit(visibility));
  if (fit.a.cols() == 0) return result;
  // With the deviations that rotations have settled to.
  result.condition_number = identifiability(fit.std.cwiseInverse().asDiagonal() * equations.a,
                                            fit.std.cwiseInverse().asDiagonal() * equations.largest, kJoints)
                                .condition_number;
  const double variance = row_variance(fit, result);
  const LeftOut by_pose = leave_out(fit, poses);
  result.model_error = result.deviations_contradicted || repeats_agree_too_well(fit, samples, poses) ||
                       (!fit.deviations_stated && result.model == ElasticModel::kJointsOnly &&
                        result.models.joints_suffice_tail < kContradiction);
  const Eigen::MatrixXd covariance = covariance_of(fit, by_pose, poses.count, variance, result);
  estimate(fit, covariance, result);
  residual_sizes(fit, result);
  result.cross_validation = {by_pose.rms_m(equations), leave_out(fit, blocks).rms_m(equations), poses.count,
                             blocks.count, by_pose.samples_not_predicted()};
  if (!result.deviations_known) return result;
  const bool agreed = fit.deviations_stated && !result.deviations_contradicted;
  if (!agreed || result.model_error)
    result.discrepancy =
        discrepancy(fit, by_pose, poses.count, result.degrees_of_freedom, covariance, samples);
  result.outliers = outliers(fit, {options.huber, agreed});
  return result;
}

}  // namespace stablecut::robot
