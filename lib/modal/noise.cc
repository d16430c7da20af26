#include "modal/noise.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace stablecut {
namespace {

constexpr Eigen::Index kHalfWindow = 24;
// The square of a complex Gaussian is exponential: its median is log 2 times its mean.
const double kMedianOfExponential = std::log(2.0);

}  // namespace

Eigen::VectorXd estimated_variance(const Eigen::VectorXcd& values) {
  const Eigen::Index lines = values.size();
  if (lines < 5) return Eigen::VectorXd::Zero(lines);
  // Sum of squares of (1, -4, 6, -4, 1) is 70.
  Eigen::VectorXd square(lines - 4);
  for (Eigen::Index i = 0; i < square.size(); ++i) {
    square[i] = std::norm(values[i] - 4.0 * values[i + 1] + 6.0 * values[i + 2] - 4.0 * values[i + 3] + values[i + 4]) / 70;
  }
  const Eigen::Index half = lines < 12 ? lines : kHalfWindow;
  Eigen::VectorXd variance(lines);
  std::vector<double> window;
  for (Eigen::Index i = 0; i < lines; ++i) {
    const Eigen::Index from = std::max<Eigen::Index>(0, std::min(i - 2 - half, square.size() - 1 - half));
    const Eigen::Index to = std::min<Eigen::Index>(square.size() - 1, std::max(i - 2 + half, half));
    window.assign(square.begin() + from, square.begin() + to + 1);
    const auto middle = window.begin() + static_cast<std::ptrdiff_t>(window.size() / 2);
    std::nth_element(window.begin(), middle, window.end());
    variance[i] = *middle / kMedianOfExponential;
  }
  return variance;
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
