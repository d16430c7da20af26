#include "dynamics/noise.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace stablecut {
namespace {

constexpr Eigen::Index kHalfWindow = 24;
// The square of a complex Gaussian is exponential: its median is log 2 times its mean.
const double kMedianOfExponential = std::log(2.0);

// Median of `square` over a window around each line, as the mean that it stands for. Square i belongs to line
// i + 2.
Eigen::VectorXd windowed_mean(const Eigen::VectorXd& square) {
  const Eigen::Index lines = square.size() + 4;
  const Eigen::Index half = std::min(kHalfWindow, square.size() / 2);
  Eigen::VectorXd mean(lines);
  std::vector<double> window;
  for (Eigen::Index i = 0; i < lines; ++i) {
    const Eigen::Index centre = std::clamp<Eigen::Index>(i - 2, half, square.size() - 1 - half);
    window.assign(square.begin() + centre - half, square.begin() + centre + half + 1);
    const auto middle = window.begin() + half;
    std::nth_element(window.begin(), middle, window.end());
    mean[i] = *middle / kMedianOfExponential;
  }
  return mean;
}

// Log-likelihood of squared complex Gaussians.
double likelihood(const Eigen::VectorXd& square, const Eigen::VectorXd& variance) {
  const auto inner = variance.segment(2, square.size()).array().max(1e-300);
  return -(inner.log() + square.array() / inner).sum();
}

}  // namespace

Eigen::VectorXd estimated_variance(const Eigen::VectorXcd& values, const Eigen::VectorXd& size) {
  const Eigen::Index lines = values.size();
  if (lines < 6) return Eigen::VectorXd::Zero(lines);
  // Sum of squares of (1, -4, 6, -4, 1) is 70.
  const Eigen::Index count = lines - 4;
  const Eigen::VectorXd square =
      (values.head(count) - 4.0 * values.segment(1, count) + 6.0 * values.segment(2, count) -
       4.0 * values.segment(3, count) + values.tail(count))
          .cwiseAbs2() /
      70;
  const Eigen::VectorXd plain = windowed_mean(square);
  const Eigen::VectorXd size_square = size.cwiseAbs2().array().max(1e-300);
  const Eigen::VectorXd following =
      windowed_mean(square.cwiseQuotient(size_square.segment(2, count))).cwiseProduct(size_square);
  return likelihood(square, following) > likelihood(square, plain) ? following : plain;
}

double correlation_length(const Eigen::VectorXcd& residual) {
  const double power = residual.squaredNorm();
  if (power == 0) return 1;
  double length = 1;
  const Eigen::Index most = residual.size() / 4;
  for (Eigen::Index lag = 1; lag < most; ++lag) {
    const double correlation =
        residual.head(residual.size() - lag).dot(residual.tail(residual.size() - lag)).real() / power;
    if (correlation < 0.1) break;
    length += 2 * correlation;
  }
  return length;
}

}  // namespace stablecut
