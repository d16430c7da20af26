#include "dynamics/noise.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace stablecut::dynamics {
namespace {

constexpr Eigen::Index kHalfWindow = 24;  // lines on either side of a window's middle line
constexpr Eigen::Index kWindowStep = 8;   // lines that share a window's median
constexpr Eigen::Index kLeastNoiseLines = 6;
constexpr double kPooledFreedom = 30;  // independent values behind a variance that becomes a weight
// The squared modulus of a complex Gaussian is exponentially distributed: its median is log 2 times its mean
// [Hampel1974].
const double kMedianOfExponential = std::log(2.0);
constexpr int kScoringSteps = 30;
constexpr double kScoringTolerance = 1e-4;  // relative change of both parts that ends the scoring
constexpr double kLeastPart = 1e-6;         // of the part before: a step never makes one negative
constexpr double kLeastVariance = 1e-300;   // stands in for 0 where a logarithm or quotient is taken
constexpr double kLeastCorrelation = 0.1;   // below it a correlation counts as none, and the sum ends
constexpr Eigen::Index kLagFraction = 4;    // lags up to this fraction of the lines

// The median of `square` over a window around each line, divided by log 2, which makes it an estimate of the
// mean. Square i belongs to line i + 2. The window is shorter where there are fewer squares, and stays
// inside.
Eigen::VectorXd windowed_mean(const Eigen::VectorXd& square) {
  const Eigen::Index lines = square.size() + 4;
  const Eigen::Index half = std::min(kHalfWindow, (square.size() - 1) / 2);
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

// Weights of the fourth divided differences over five neighbouring lines, scaled to a sum of squares of 1:
// for equally spaced lines (1, -4, 6, -4, 1) / sqrt(70). [lines - 4 x 5]
Eigen::Array<double, Eigen::Dynamic, 5> fourth_differences(const Eigen::VectorXd& lines) {
  const Eigen::Index count = lines.size() - 4;
  const auto line = [&](Eigen::Index i) { return lines.segment(i, count).array(); };
  // In units of the distance from the first to the fifth line, so that nothing over- or underflows.
  const Eigen::ArrayXd stretch = line(4) - line(0);
  Eigen::Array<double, Eigen::Dynamic, 5> weights = Eigen::Array<double, Eigen::Dynamic, 5>::Ones(count, 5);
  for (Eigen::Index a = 0; a < 5; ++a) {
    for (Eigen::Index b = 0; b < 5; ++b)
      if (b != a) weights.col(a) *= stretch / (line(a) - line(b));
  }
  const Eigen::ArrayXd norm = weights.square().rowwise().sum().sqrt();
  return weights.colwise() / norm;
}

// Log-likelihood, up to a constant, of complex Gaussians with these squared moduli and variances.
double log_likelihood(const Eigen::VectorXd& square, const Eigen::VectorXd& variance) {
  const auto positive = variance.array().max(kLeastVariance);
  return -(positive.log() + square.array() / positive).sum();
}

// The likeliest variance among a multiple of the first shape, a multiple of the second, and a sum of both,
// which Fisher scoring [Fisher1925] finds. Shapes are squared deviations, [lines].
Eigen::VectorXd likeliest_sum(const Eigen::VectorXd& square, const Eigen::VectorXd& first_shape,
                              const Eigen::VectorXd& second_shape) {
  const auto scaled = [](const Eigen::VectorXd& shape) -> Eigen::ArrayXd {
    return shape.array().max(kLeastVariance) / std::max(shape.mean(), kLeastVariance);
  };
  const Eigen::ArrayXd a = scaled(first_shape), b = scaled(second_shape);
  const double of_a = (square.array() / a).mean(), of_b = (square.array() / b).mean();
  Eigen::Vector2d part(of_a / 2, of_b / 2);
  for (int step = 0; step < kScoringSteps; ++step) {
    const Eigen::ArrayXd weight = (part[0] * a + part[1] * b).square().max(kLeastVariance).inverse();
    const Eigen::ArrayXd weighted_a = weight * a, weighted_b = weight * b;
    Eigen::Matrix2d normal;
    normal << (weighted_a * a).sum(), (weighted_a * b).sum(), (weighted_a * b).sum(), (weighted_b * b).sum();
    const Eigen::Vector2d right((weighted_a * square.array()).sum(), (weighted_b * square.array()).sum());
    const Eigen::Vector2d next = normal.inverse() * right;
    if (!next.allFinite()) break;
    const Eigen::Vector2d last = std::exchange(part, next.cwiseMax(kLeastPart * part));
    if (((part - last).array().abs() <= kScoringTolerance * last.array().abs()).all()) break;
  }
  Eigen::VectorXd best = of_a * a;
  for (const Eigen::VectorXd& other :
       {Eigen::VectorXd(of_b * b), Eigen::VectorXd(part[0] * a + part[1] * b)}) {
    if (log_likelihood(square, other) > log_likelihood(square, best)) best = other;
  }
  return best;
}

// The variances [lines x shapes] of the shape that is likeliest on the whole; where it `may_change`, in
// windows those of another one that is clearly likelier there. `likely` [squares x shapes]: log-likelihood of
// each square.
Eigen::VectorXd likeliest_shape(const Eigen::MatrixXd& variance, const Eigen::MatrixXd& likely,
                                bool may_change) {
  const Eigen::Index lines = variance.rows(), count = likely.rows();
  Eigen::Index best = 0;
  likely.colwise().sum().maxCoeff(&best);
  Eigen::VectorXd result = variance.col(best);
  const Eigen::Index half = std::min(kHalfWindow, (count - 1) / 2);
  for (Eigen::Index first = 0; may_change && first < lines; first += kWindowStep) {
    const Eigen::Index centre = std::clamp<Eigen::Index>(first - 2 + kWindowStep / 2, half, count - 1 - half);
    const Eigen::RowVectorXd here = likely.middleRows(centre - half, 2 * half + 1).colwise().sum();
    Eigen::Index local = 0;
    // [Schwarz1978]: another shape is a parameter more.
    if (here.maxCoeff(&local) < here[best] + std::log(static_cast<double>(lines)) / 2) continue;
    const Eigen::Index block = std::min(kWindowStep, lines - first);
    result.segment(first, block) = variance.col(local).segment(first, block);
  }
  return result;
}

// Mean over `reach` lines on either side of each line, of a window that stays inside the curve.
Eigen::VectorXd running_mean(const Eigen::VectorXd& square, Eigen::Index reach) {
  const Eigen::Index half = std::min(reach, (square.size() - 1) / 2);
  Eigen::VectorXd mean(square.size());
  for (Eigen::Index i = 0; i < square.size(); ++i) {
    const Eigen::Index first = std::clamp<Eigen::Index>(i - half, 0, square.size() - 1 - 2 * half);
    mean[i] = square.segment(first, 2 * half + 1).mean();
  }
  return mean;
}

}  // namespace

NoiseShapes floor_shapes(const Eigen::VectorXd& omega) {
  return {Eigen::VectorXd::Ones(omega.size()), omega.cwiseInverse(), omega.cwiseAbs2().cwiseInverse()};
}

Eigen::VectorXd estimated_variance(const Eigen::VectorXd& lines, const Eigen::VectorXcd& values,
                                   const Eigen::VectorXd& size, const NoiseShapes& floors, bool may_change) {
  if (values.size() < kLeastNoiseLines) return Eigen::VectorXd::Zero(values.size());
  const Eigen::Index count = values.size() - 4;
  const Eigen::Array<double, Eigen::Dynamic, 5> weights = fourth_differences(lines);
  const Eigen::Array<double, Eigen::Dynamic, 5> shares = weights.square();
  Eigen::ArrayXcd difference = Eigen::ArrayXcd::Zero(count);
  for (Eigen::Index a = 0; a < 5; ++a)
    difference += weights.col(a).cast<std::complex<double>>() * values.segment(a, count).array();
  const Eigen::VectorXd square = difference.abs2();
  NoiseShapes shapes = floors;
  shapes.push_back(size);
  Eigen::MatrixXd variance(values.size(), shapes.size()), likely(count, shapes.size());
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    const Eigen::Index at = k;
    const Eigen::VectorXd v = shapes[k].cwiseAbs2().array().max(kLeastVariance);
    Eigen::VectorXd expected = Eigen::VectorXd::Zero(count);
    for (Eigen::Index a = 0; a < 5; ++a) expected.array() += shares.col(a) * v.segment(a, count).array();
    const Eigen::VectorXd level = windowed_mean(square.cwiseQuotient(expected));
    const Eigen::ArrayXd here = (level.segment(2, count).array() * expected.array()).max(kLeastVariance);
    likely.col(at) = -(here.log() + square.array() / here);
    variance.col(at) = level.cwiseProduct(v);
  }
  return likeliest_shape(variance, likely, may_change);
}

ResidualNoise residual_noise(const Eigen::VectorXcd& residual, const Eigen::VectorXd& size,
                             const NoiseShapes& floors) {
  const Eigen::VectorXd square = residual.cwiseAbs2();
  ResidualNoise noise;
  for (const Eigen::VectorXd& floor : floors) {
    const Eigen::VectorXd smooth = likeliest_sum(square, floor.cwiseAbs2(), size.cwiseAbs2());
    if (noise.smooth.size() == 0 || log_likelihood(square, smooth) > log_likelihood(square, noise.smooth))
      noise.smooth = smooth;
  }
  // Beside the smooth shape, which may be steep: at the first lines of an integrated acceleration a mean of
  // squares would be that of the first alone.
  const Eigen::VectorXd shape = noise.smooth.cwiseMax(kLeastVariance);
  noise.local = shape.cwiseProduct(running_mean(square.cwiseQuotient(shape), kHalfWindow));
  // [Schwarz1978]: each window of the running mean counts as a parameter.
  const auto lines = static_cast<double>(square.size());
  const double windows = lines / static_cast<double>(2 * kHalfWindow + 1);
  noise.is_local = log_likelihood(square, noise.local) - log_likelihood(square, noise.smooth) >
                   windows * std::log(lines) / 2;
  return noise;
}

Eigen::VectorXd pooled_variance(const Eigen::VectorXd& estimates, double freedom, const Eigen::VectorXd& size,
                                const NoiseShapes& floors) {
  const auto reach = static_cast<Eigen::Index>(std::ceil((kPooledFreedom / freedom - 1) / 2));
  if (reach <= 0) return estimates;
  const Eigen::VectorXd smooth =
      residual_noise(estimates.cwiseSqrt().cast<std::complex<double>>(), size, floors)
          .smooth.cwiseMax(kLeastVariance);
  return smooth.cwiseProduct(running_mean(estimates.cwiseQuotient(smooth), reach));
}

double correlation_length(const Eigen::VectorXcd& residual) {
  const double power = residual.squaredNorm();
  if (power == 0) return 1;
  double length = 1;
  const Eigen::Index most = residual.size() / kLagFraction;
  for (Eigen::Index lag = 1; lag < most; ++lag) {
    const double correlation =
        residual.head(residual.size() - lag).dot(residual.tail(residual.size() - lag)).real() / power;
    if (correlation < kLeastCorrelation) break;
    length += 2 * correlation;
  }
  return length;
}

}  // namespace stablecut::dynamics
