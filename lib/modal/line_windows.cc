#include "modal/line_windows.h"

#include <algorithm>
#include <cmath>

#include "numerics/order_statistics.h"

namespace stablecut::modal {
namespace {

constexpr double kWindowRatio = 1.1225;      // of the last line's frequency to the first's: 2^(1/6)
constexpr Eigen::Index kLeastWindow = 5;     // lines
constexpr double kSmallestModulus = 1e-300;  // stands in for |H| = 0 in a quotient

}  // namespace

std::vector<LineSpan> octave_windows(const Eigen::VectorXd& hz) {
  std::vector<LineSpan> windows;
  for (Eigen::Index first = 0; first < hz.size();) {
    Eigen::Index end = std::min(first + kLeastWindow, hz.size());
    while (end < hz.size() && hz[end] <= kWindowRatio * hz[first]) ++end;
    // Too few lines for another window belong to this one.
    if (hz.size() - end < kLeastWindow) end = hz.size();
    windows.push_back({first, end});
    first = end;
  }
  return windows;
}

WindowSummary summary_of(const LineSpan& window, const Eigen::VectorXd& hz, const Eigen::VectorXcd& h,
                         const Eigen::VectorXd& variance) {
  std::vector<double> size, noise, imaginary, real;
  for (Eigen::Index i = window.first; i < window.end; ++i) {
    const double modulus = std::max(std::abs(h[i]), kSmallestModulus);
    size.push_back(modulus);
    noise.push_back(std::sqrt(variance[i]) / modulus);
    imaginary.push_back(h[i].imag() / modulus);
    real.push_back(h[i].real() / modulus);
  }
  using numerics::median;
  return {hz[window.first],
          hz[window.end - 1],
          median(size),
          median(noise),
          median(imaginary),
          median(real),
          static_cast<double>(window.end - window.first)};
}

}  // namespace stablecut::modal
