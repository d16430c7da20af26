#include "robot/compliance_fit.h"

#include <algorithm>
#include <cmath>

#include "numerics/order_statistics.h"
#include "robot/least_squares.h"

namespace stablecut::robot {
namespace {

constexpr double kHuber = 2;                // deviations of a sample beyond which it counts less
constexpr double kMedianOfNormal = 0.6745;  // of the size of a unit normal variable
constexpr int kMostReweightings = 100;
constexpr double kSettled = 1e-12;   // relative change of the solution that ends the reweightings
constexpr double kNoFreedom = 1e-9;  // degrees of freedom below which no deviation can be estimated

std::vector<SampleRows> sample_rows(const std::vector<int>& sample) {
  std::vector<SampleRows> samples;
  for (std::size_t i = 0; i < sample.size(); ++i) {
    if (samples.empty() || samples.back().sample != sample[i])
      samples.push_back({sample[i], static_cast<Eigen::Index>(i), 0});
    ++samples.back().count;
  }
  return samples;
}

void choose_columns(ComplianceFit& fit) {
  fit.seen = identifiability(fit.std.cwiseInverse().asDiagonal() * fit.equations.a,
                             fit.std.cwiseInverse().asDiagonal() * fit.equations.largest, kJoints);
  const std::vector<Eigen::Index> columns(fit.seen.independent.begin(), fit.seen.independent.end());
  fit.a = fit.equations.a(Eigen::all, columns);
}

void solve(ComplianceFit& fit) {
  if (fit.a.cols() == 0) return;
  // Of joints that cannot be told apart only a mixture is estimated, which may have any sign.
  std::vector<bool> not_negative;
  for (const int spring : fit.seen.independent) {
    not_negative.push_back(fit.seen.visibility[spring] == Visibility::kVisible);
  }
  const Eigen::VectorXd whitening = fit.whitening();
  fit.solution = bounded_least_squares(whitening.asDiagonal() * fit.a,
                                       whitening.cwiseProduct(fit.equations.b), not_negative);
  fit.residual = fit.equations.b - fit.a * fit.solution;
}

// The deviation of the rows of one kind (rotations or deflections), from their residuals and the degrees of
// freedom that the fit leaves them; 0 where it leaves none.
double deviation_of_kind(const ComplianceFit& fit, const Eigen::MatrixXd& inverse_normal, bool rotation) {
  double sum = 0, freedom = 0;
  for (Eigen::Index i = 0; i < fit.residual.size(); ++i) {
    if (fit.equations.rotation[i] != rotation) continue;
    const double per_std = 1 / fit.std[i];
    sum += fit.weight[i] * fit.residual[i] * fit.residual[i];
    freedom += 1 - fit.weight[i] * per_std * per_std *
                       (fit.a.row(i) * inverse_normal * fit.a.row(i).transpose()).value();
  }
  return freedom > kNoFreedom ? std::sqrt(sum / freedom) : 0;
}

void balance_rotations(ComplianceFit& fit) {
  const Eigen::MatrixXd inverse_normal = inverse_normal_matrix(fit.whitening().asDiagonal() * fit.a);
  const double std[2] = {deviation_of_kind(fit, inverse_normal, false),
                         deviation_of_kind(fit, inverse_normal, true)};
  // Without residuals (exact data) or without degrees of freedom there is nothing to settle.
  const double rounding = kRounding * fit.equations.b.cwiseAbs().maxCoeff();
  if (!(std[0] > rounding) || !(std[1] > rounding)) return;
  for (Eigen::Index i = 0; i < fit.std.size(); ++i) fit.std[i] = std[fit.equations.rotation[i]];
}

// Huber's weights [Huber1964], of whole samples: by the RMS of a sample's residuals over their deviations.
void reweight(ComplianceFit& fit) {
  const double unit = fit.robust_deviation();
  if (!(unit > 0)) return;
  for (const SampleRows& rows : fit.samples) {
    const Eigen::VectorXd z =
        fit.residual.segment(rows.first, rows.count).cwiseQuotient(fit.std.segment(rows.first, rows.count));
    const double deviations = z.norm() / (std::sqrt(static_cast<double>(rows.count)) * unit);
    fit.weight.segment(rows.first, rows.count).setConstant(deviations > kHuber ? kHuber / deviations : 1);
  }
}

}  // namespace

double ComplianceFit::robust_deviation() const {
  if (deviations_stated) return 1;
  std::vector<double> z(residual.size());
  for (std::size_t i = 0; i < z.size(); ++i) z[i] = std::abs(residual[i]) / std[i];
  return numerics::median(std::move(z)) / kMedianOfNormal;
}

double ComplianceFit::mean_influence_slope() const {
  double sum = 0;
  for (const SampleRows& rows : samples) {
    const double w = weight[rows.first], count = static_cast<double>(rows.count);
    sum += w < 1 ? w * (count - 1) : count;
  }
  return sum / static_cast<double>(weight.size());
}

ComplianceFit fit_compliances(const ComplianceEquations& equations, bool huber) {
  const bool stated = equations.std.size() > 0;
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(equations.a.rows());
  ComplianceFit fit{
      equations, sample_rows(equations.sample), stated, stated ? equations.std : ones, ones, {}, {}, {}, {}};
  choose_columns(fit);
  solve(fit);
  const bool unbalanced = !stated && std::find(equations.rotation.begin(), equations.rotation.end(), true) !=
                                         equations.rotation.end();
  for (int i = 0; i < kMostReweightings && fit.a.cols() > 0 && (unbalanced || huber); ++i) {
    const Eigen::VectorXd before = fit.solution;
    if (unbalanced) balance_rotations(fit);
    if (huber) reweight(fit);
    solve(fit);
    if ((fit.solution - before).norm() <= kSettled * fit.solution.norm()) break;
  }
  return fit;
}

}  // namespace stablecut::robot
