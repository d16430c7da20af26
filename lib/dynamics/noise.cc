#include "dynamics/noise.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <vector>

namespace stablecut {
namespace {

constexpr Eigen::Index kHalfWindow = 24;
constexpr Eigen::Index kWindowStep = 8;  // lines that share a window's median
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
    if (i % kWindowStep != 0) {
      mean[i] = mean[i - 1];
      continue;
    }
    const Eigen::Index centre =
        std::clamp<Eigen::Index>(i - 2 + kWindowStep / 2, half, square.size() - 1 - half);
    window.assign(square.begin() + centre - half, square.begin() + centre + half + 1);
    const auto middle = window.begin() + half;
    std::nth_element(window.begin(), middle, window.end());
    mean[i] = *middle / kMedianOfExponential;
  }
  return mean;
}

// Log-likelihood of squared complex Gaussians.
double likelihood(const Eigen::VectorXd& square, const Eigen::VectorXd& variance) {
  const auto positive = variance.array().max(1e-300);
  return -(positive.log() + square.array() / positive).sum();
}

// The likeliest floor + share * size_square, both not negative, by Fisher scoring.
Eigen::VectorXd floor_and_share(const Eigen::VectorXd& square, const Eigen::VectorXd& size_square) {
  constexpr int kSteps = 30;
  const double mean = square.mean();
  const Eigen::ArrayXd size = size_square.array() / std::max(size_square.mean(), 1e-300);
  const double share = (square.array() / size.max(1e-300)).mean();
  Eigen::Vector2d part(mean / 2, mean / 2);
  for (int step = 0; step < kSteps; ++step) {
    const Eigen::ArrayXd weight = (part[0] + part[1] * size).square().max(1e-300).inverse();
    Eigen::Matrix2d normal;
    normal << weight.sum(), (weight * size).sum(), (weight * size).sum(), (weight * size.square()).sum();
    const Eigen::Vector2d right((weight * square.array()).sum(), (weight * size * square.array()).sum());
    const Eigen::Vector2d next = normal.inverse() * right;
    if (!next.allFinite()) break;
    part = next.cwiseMax(1e-6 * part);
  }
  Eigen::VectorXd best = Eigen::VectorXd::Constant(square.size(), mean);
  for (const Eigen::VectorXd& other :
       {Eigen::VectorXd(share * size), Eigen::VectorXd(part[0] + part[1] * size)}) {
    if (likelihood(square, other) > likelihood(square, best)) best = other;
  }
  return best;
}

Eigen::VectorXd running_mean(const Eigen::VectorXd& square) {
  const Eigen::Index half = std::min(kHalfWindow, (square.size() - 1) / 2);
  Eigen::VectorXd mean(square.size());
  for (Eigen::Index i = 0; i < square.size(); ++i) {
    const Eigen::Index first = std::clamp<Eigen::Index>(i - half, 0, square.size() - 1 - 2 * half);
    mean[i] = square.segment(first, 2 * half + 1).mean();
  }
  return mean;
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
  return likelihood(square, following.segment(2, count)) > likelihood(square, plain.segment(2, count))
             ? following
             : plain;
}

ResidualNoise residual_noise(const Eigen::VectorXcd& residual, const Eigen::VectorXd& size) {
  const Eigen::VectorXd square = residual.cwiseAbs2();
  ResidualNoise noise{floor_and_share(square, size.cwiseAbs2()), running_mean(square)};
  // Schwarz: each window is a parameter more.
  const auto lines = static_cast<double>(square.size());
  const double windows = lines / static_cast<double>(2 * kHalfWindow + 1);
  noise.is_local =
      likelihood(square, noise.local) - likelihood(square, noise.smooth) > windows * std::log(lines) / 2;
  return noise;
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
