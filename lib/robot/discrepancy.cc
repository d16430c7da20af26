#include "robot/discrepancy.h"

#include <algorithm>
#include <limits>

#include "numerics/distributions.h"
#include "numerics/golden_section.h"

namespace stablecut::robot {
namespace {

constexpr double kShare = 0.95;      // of left-out deflections that the stated deviations shall cover
constexpr double kQuantile = 0.975;  // of a normal variable: kShare, two-sided
constexpr int kTrials = 33;          // of the relative part's share before the golden section
constexpr int kSteps = 30;           // of it: 0.62^30 of a trial's width

// A deflection's length: predicted from the other poses, its error, the error's variance by the covariance.
struct Length {
  double predicted, error, variance;
};

std::vector<Length> left_out_lengths(const ComplianceFit& fit, const LeftOut& by_pose,
                                     const Eigen::MatrixXd& covariance) {
  std::vector<Length> lengths;
  for (const SampleRows& sample : fit.samples) {
    if (!by_pose.predicted[sample.sample]) continue;
    double measured = 0, predicted = 0;
    Eigen::RowVectorXd slope = Eigen::RowVectorXd::Zero(fit.a.cols());
    for (Eigen::Index i = sample.first; i < sample.first + sample.count; ++i) {
      if (fit.equations.rotation[i]) continue;
      const double component = fit.equations.b[i] - by_pose.error[i];
      measured += fit.equations.b[i] * fit.equations.b[i];
      predicted += component * component;
      slope += component * fit.a.row(i);
    }
    if (!(predicted > 0)) continue;
    const double length = std::sqrt(predicted);
    // With the robust loss a sample counts by its influence.
    const double error = std::sqrt(fit.weight[sample.first]) * (std::sqrt(measured) - length);
    lengths.push_back({length, error, (slope * covariance * slope.transpose()).value() / predicted});
  }
  return lengths;
}

// The share of the relative part, 0 to 1: errors with variances in proportion to share length^2 / (mean
// length^2) + 1 - share are most likely.
double relative_share(const std::vector<Length>& lengths, double mean_square) {
  const auto cost = [&](double share) {
    double sum = 0, logs = 0;
    for (const Length& one : lengths) {
      const double variance = share * one.predicted * one.predicted / mean_square + 1 - share;
      sum += one.error * one.error / variance;
      logs += std::log(variance);
    }
    return logs + static_cast<double>(lengths.size()) * std::log(sum);
  };
  struct Trial {
    double share, cost;
  };
  const auto trial = [&](double share) { return Trial{share, cost(share)}; };
  const auto better = [](const Trial& a, const Trial& b) { return a.cost < b.cost; };
  Trial best = trial(0);
  for (int i = 1; i < kTrials; ++i) {
    const Trial here = trial(static_cast<double>(i) / (kTrials - 1));
    if (better(here, best)) best = here;
  }
  const double width = 1.0 / (kTrials - 1);
  best = numerics::golden_section(
      std::max(0.0, best.share - width), std::min(1.0, best.share + width), best, kSteps,
      [](const Trial& at) { return at.share; }, trial, better, [](const Trial&) { return false; });
  return best.share;
}

double root_mean_square_load(const std::vector<LoadSample>& samples) {
  double sum = 0;
  for (const LoadSample& sample : samples) sum += sample.force_n.squaredNorm();
  return std::sqrt(sum / static_cast<double>(samples.size()));
}

}  // namespace

Discrepancy discrepancy(const ComplianceFit& fit, const LeftOut& by_pose, int poses, double freedom,
                        const Eigen::MatrixXd& covariance, const std::vector<LoadSample>& samples) {
  Discrepancy result;
  result.force_n = root_mean_square_load(samples);
  const std::vector<Length> lengths = left_out_lengths(fit, by_pose, covariance);
  const double largest = fit.equations.b.cwiseAbs().maxCoeff();
  double squares = 0, mean_square = 0;
  for (const Length& one : lengths) {
    squares += one.error * one.error / static_cast<double>(lengths.size());
    mean_square += one.predicted * one.predicted / static_cast<double>(lengths.size());
  }
  if (!(std::sqrt(squares) > kRounding * largest)) return result;  // exact samples
  const double share = relative_share(lengths, mean_square);
  // In units of which size^2 is the mean variance; what each error needs of it to be within the quantile.
  const double normal = numerics::student_t_quantile(kQuantile, std::numeric_limits<double>::infinity());
  std::vector<double> needed;
  for (const Length& one : lengths) {
    const double unit = share * one.predicted * one.predicted / mean_square + 1 - share;
    needed.push_back(std::max(0.0, std::pow(one.error / normal, 2) - one.variance) / unit);
  }
  std::sort(needed.begin(), needed.end());
  const auto count = static_cast<double>(needed.size());
  const double rank =
      std::ceil((count + 1) * kShare);  // of exchangeable errors a new one is below it so often
  double size = needed[static_cast<std::size_t>(std::min(rank, count)) - 1];
  if ((poses + 1) * kShare > poses) {
    // Too few for a quantile.
    const double wider = numerics::student_t_quantile(kQuantile, freedom) / normal;
    size = std::max(size, squares * wider * wider);
  }
  result.relative = std::sqrt(size * share / mean_square);
  result.absolute_m = std::sqrt(size * (1 - share));
  return result;
}

}  // namespace stablecut::robot
