#include "robot/leave_one_out.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "numerics/distributions.h"
#include "robot/least_squares.h"

namespace stablecut::robot {
namespace {

constexpr double kOutlierTail = 6.3e-5;  // two-sided probability of 4 deviations of a normal variable
constexpr double kAlone = 1e-9;          // least pivot of 1 - H: below, nothing else says it

// The weighted equations of the joints that are free to move, and each sample's part of 1 - H, where
// H = A (A^T A)^-1 A^T is the hat matrix.
class LeaveOneOut {
 public:
  explicit LeaveOneOut(const ComplianceFit& fit) {
    for (Eigen::Index i = 0; i < fit.solution.size(); ++i) {
      if (fit.solution[i] != 0) free_.push_back(i);
    }
    if (free_.empty()) return;
    whitening_ = fit.whitening();
    a_ = whitening_.asDiagonal() * fit.a(Eigen::all, free_);
    inverse_normal_ = inverse_normal_matrix(a_);
  }

  Eigen::Index unknowns() const { return a_.cols(); }
  const Eigen::VectorXd& whitening() const { return whitening_; }

  // At most three deflections and three rotations.
  using Square = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 6>;
  struct Sample {
    Square remainder;  // 1 - H of the sample's rows
    Eigen::LDLT<Square> factor;
    bool alone;  // without it some compliance that it needs cannot be estimated
  };
  Sample without(const SampleRows& sample) const {
    const Eigen::MatrixXd part = a_(Eigen::seqN(sample.first, sample.count), Eigen::all);
    Sample result;
    result.remainder =
        Square::Identity(sample.count, sample.count) - part * inverse_normal_ * part.transpose();
    result.factor.compute(result.remainder);
    result.alone = !(result.factor.vectorD().minCoeff() > kAlone);
    return result;
  }

 private:
  std::vector<Eigen::Index> free_;
  Eigen::VectorXd whitening_;
  Eigen::MatrixXd a_, inverse_normal_;
};

}  // namespace

std::vector<Outlier> outliers(const ComplianceFit& fit, const OutlierOptions& options) {
  std::vector<Outlier> found;
  const LeaveOneOut others(fit);
  if (others.unknowns() == 0) return found;
  const double robust = options.huber ? fit.robust_deviation() : 0;
  const Eigen::VectorXd r = others.whitening().cwiseProduct(fit.residual);
  const double sum = r.squaredNorm(), freedom = static_cast<double>(r.size() - others.unknowns());
  // Exact samples have rounding for residuals, and no outliers.
  const double rounding = kRounding * others.whitening().cwiseProduct(fit.equations.b).cwiseAbs().maxCoeff();
  // Mean square in variances of `count` numbers whose squares sum to `square`, and the chance of as much.
  const auto judge = [&](double square, double count) {
    double variance = 1, left = std::numeric_limits<double>::infinity();
    if (robust > 0) {
      variance = robust * robust;
    } else if (!options.deviations_agreed) {
      left = freedom - count;
      variance = left > 0 ? std::max(sum - square, 0.0) / left : sum / freedom;
    }
    const double ratio = square / count / std::max(variance, rounding * rounding);
    return std::pair{ratio, left > 0 ? numerics::f_tail(ratio, count, left) : 1};
  };
  for (const SampleRows& sample : fit.samples) {
    const auto left = others.without(sample);
    if (left.alone) continue;
    const Eigen::VectorXd own = r(Eigen::seqN(sample.first, sample.count));
    // With the robust loss the weights have spared the fit, and the residual counts in full.
    const double weight = fit.weight[sample.first];
    auto worst = judge(own.dot(left.factor.solve(own)) / weight, static_cast<double>(sample.count));
    // A single bad component shows in its own row.
    for (Eigen::Index i = 0; i < sample.count; ++i) {
      const auto row = judge(own[i] * own[i] / left.remainder(i, i) / weight, 1);
      if (row.second < worst.second) worst = row;
    }
    // The whole sample and each of its rows were compared: as many chances [Dunn1961].
    if (!(worst.second * static_cast<double>(sample.count + 1) < kOutlierTail)) continue;
    if (!(own.norm() > rounding)) continue;
    Outlier outlier{sample.sample, 0, std::sqrt(worst.first), weight};
    for (Eigen::Index i = sample.first; i < sample.first + sample.count; ++i) {
      if (!fit.equations.rotation[i]) outlier.residual_m = std::hypot(outlier.residual_m, fit.residual[i]);
    }
    found.push_back(outlier);
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Outlier& x, const Outlier& y) { return x.deviations > y.deviations; });
  return found;
}

}  // namespace stablecut::robot
