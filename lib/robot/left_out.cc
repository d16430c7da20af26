#include "robot/left_out.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "robot/least_squares.h"

namespace stablecut::robot {
namespace {

constexpr double kAlone = 1e-9;  // least pivot of 1 - H: below, nothing else says it

// (1 - H)^-1 r for the rows of a group, q being their part of the orthogonal factor [k x n], H = q q^T. By
// the smaller of the two matrices 1 - q q^T and 1 - q^T q. Nothing where the group is alone.
std::optional<Eigen::VectorXd> without_group(const Eigen::MatrixXd& q, const Eigen::VectorXd& r) {
  const bool tall = q.rows() > q.cols();
  const Eigen::Index size = std::min(q.rows(), q.cols());
  Eigen::MatrixXd remainder = Eigen::MatrixXd::Identity(size, size);
  remainder -= tall ? Eigen::MatrixXd(q.transpose() * q) : Eigen::MatrixXd(q * q.transpose());
  const Eigen::LDLT<Eigen::MatrixXd> factor(remainder);
  if (!(factor.vectorD().minCoeff() > kAlone)) return std::nullopt;
  if (!tall) return Eigen::VectorXd(factor.solve(r));
  return Eigen::VectorXd(r + q * factor.solve(q.transpose() * r));
}

}  // namespace

std::optional<double> LeftOut::rms_m(const ComplianceEquations& equations) const {
  double sum = 0;
  int count = 0;
  for (Eigen::Index i = 0; i < error.size(); ++i) {
    if (equations.rotation[i] || !predicted[equations.sample[i]]) continue;
    sum += error[i] * error[i];
    ++count;
  }
  return count > 0 ? std::optional(std::sqrt(sum / count)) : std::nullopt;
}

int LeftOut::samples_not_predicted() const {
  return static_cast<int>(std::count(predicted.begin(), predicted.end(), false));
}

LeftOut leave_out(const ComplianceFit& fit, const SampleGroups& groups) {
  std::vector<Eigen::Index> free;
  for (Eigen::Index i = 0; i < fit.solution.size(); ++i) {
    if (fit.solution[i] != 0) free.push_back(i);
  }
  LeftOut result;
  result.error = fit.residual;
  result.predicted.assign(groups.of_sample.size(), true);
  result.jackknife = Eigen::MatrixXd::Zero(fit.a.cols(), fit.a.cols());
  if (free.empty()) return result;
  const Eigen::VectorXd whitening = fit.whitening();
  const Eigen::MatrixXd a = whitening.asDiagonal() * fit.a(Eigen::all, free);
  const Eigen::MatrixXd root = triangular_factor(a);
  const Eigen::MatrixXd q = root.triangularView<Eigen::Upper>().solve<Eigen::OnTheRight>(a);
  const Eigen::VectorXd r = whitening.cwiseProduct(fit.residual);
  std::vector<std::vector<Eigen::Index>> rows(groups.count);
  for (const SampleRows& sample : fit.samples) {
    for (Eigen::Index i = 0; i < sample.count; ++i)
      rows[groups.of_sample[sample.sample]].push_back(sample.first + i);
  }
  const Eigen::Index n = free.size();
  Eigen::MatrixXd changes = Eigen::MatrixXd::Zero(n, n);
  for (const std::vector<Eigen::Index>& group : rows) {
    const Eigen::MatrixXd part = q(group, Eigen::all);
    const auto error = without_group(part, r(group));
    if (!error) {
      for (const Eigen::Index i : group) result.predicted[fit.equations.sample[i]] = false;
      continue;
    }
    result.error(group) = error->cwiseQuotient(whitening(group));
    const Eigen::VectorXd change = part.transpose() * *error;
    changes += change * change.transpose();
  }
  const Eigen::MatrixXd inverse = root.triangularView<Eigen::Upper>().solve(Eigen::MatrixXd::Identity(n, n));
  result.jackknife(free, free) = inverse * changes * inverse.transpose();
  return result;
}

}  // namespace stablecut::robot
