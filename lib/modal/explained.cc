#include "modal/explained.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>

#include "base/units.h"
#include "dynamics/noise.h"
#include "modal/low_end.h"
#include "modal/maximum_likelihood.h"
#include "modal/tap_channels.h"
#include "numerics/order_statistics.h"

namespace stablecut::modal {
namespace {

constexpr double kLeastClear = 0.5;       // share of a band's lines that must stand clear of noise
constexpr Eigen::Index kLeastBand = 20;   // lines
constexpr Eigen::Index kLeastLowEnd = 5;  // lines
constexpr double kShortOctave = 1.4142135623730951;
constexpr double kLeastSize = 1e-300;  // of a value, in a quotient

struct Band {
  Eigen::Index first, count;
};

// The whole, and octaves; what is less than half of another one, or few lines, belongs to the last.
std::vector<Band> bands_of(const FitData& data) {
  std::vector<Band> bands{{0, data.lines()}};
  for (Eigen::Index first = 0; first < data.lines();) {
    Eigen::Index end = std::min(first + kLeastBand, data.lines());
    while (end < data.lines() && data.s[end].imag() < 2 * data.s[first].imag()) ++end;
    if (data.lines() - end < kLeastBand || data.highest() < kShortOctave * data.s[end].imag())
      end = data.lines();
    bands.push_back({first, end - first});
    first = end;
  }
  return bands;
}

Eigen::ArrayXd relative_errors(const FitData& data, const std::vector<dynamics::Mode>& modes,
                               const Curve& curve) {
  return (curve_of(modes, curve, data.s) - curve.h).cwiseAbs().array() /
         curve.h.cwiseAbs().array().max(kLeastSize);
}

Eigen::VectorXd noise_of(const FitData& data, const Curve& curve) {
  return dynamics::estimated_variance(data.s.imag(), curve.h, curve.h.cwiseAbs(),
                                      dynamics::floor_shapes(data.s.imag()), true);
}

// Errors on the lines of a band that stand clear of the noise; none where these are few.
std::vector<double> clear_errors(const Curve& curve, const Eigen::ArrayXd& error,
                                 const Eigen::VectorXd& noise, const Band& band) {
  std::vector<double> left;
  for (Eigen::Index i = band.first; i < band.first + band.count; ++i)
    if (noise[i] < std::norm(kNoiseShare * curve.h[i])) left.push_back(error[i]);
  if (static_cast<double>(left.size()) < kLeastClear * static_cast<double>(band.count)) left.clear();
  return left;
}

// Whether a driving point gives energy on most lines of a band, by kPositiveShare, with the sign that takes
// energy on most of all lines.
bool gives_energy(const Eigen::VectorXcd& h, const Band& band) {
  const Eigen::ArrayXd given = h.imag().array() / h.cwiseAbs().array().max(kLeastSize);
  const double sign = 2 * (given > 0).count() > given.size() ? -1 : 1;
  return 2 * (sign * given.segment(band.first, band.count) > kPositiveShare).count() > band.count;
}

}  // namespace

std::optional<Unexplained> most_unexplained(const FitData& data, const std::vector<dynamics::Mode>& modes,
                                            double least) {
  const std::vector<Band> bands = bands_of(data);
  std::optional<Unexplained> most;
  for (std::size_t c = 0; c < data.curves.size(); ++c) {
    const Curve& curve = data.curves[c];
    const Eigen::ArrayXd error = relative_errors(data, modes, curve);
    Eigen::VectorXd noise;
    for (const Band& band : bands) {
      // A median above `least` over half of the lines has a quarter of them above it.
      const auto high = (error.segment(band.first, band.count) > least).count();
      if (static_cast<double>(high) < kLeastClear / 2 * static_cast<double>(band.count)) continue;
      if (noise.size() == 0) noise = noise_of(data, curve);
      std::vector<double> left = clear_errors(curve, error, noise, band), steps;
      for (Eigen::Index i = band.first; i + 1 < band.first + band.count; ++i)
        steps.push_back(std::abs(curve.h[i + 1] - curve.h[i]) / std::max(std::abs(curve.h[i]), kLeastSize));
      if (left.empty() || numerics::median(std::move(steps)) > kNoiseShare) continue;
      const double share = numerics::median(std::move(left));
      if (share < least || (most && share <= most->error)) continue;
      most = {c, data.s[band.first].imag() / kTwoPi, data.s[band.first + band.count - 1].imag() / kTwoPi,
              share};
    }
  }
  return most;
}

bool leave_low_end(const FitData& data, const std::vector<dynamics::Mode>& modes,
                   const std::vector<bool>& driving, double up_to_hz, double least) {
  const Band low{0, (data.s.imag().array() < kTwoPi * up_to_hz).count()};
  if (low.count < kLeastLowEnd) return false;
  for (std::size_t c = 0; c < data.curves.size(); ++c) {
    const Curve& curve = data.curves[c];
    const auto sizes = curve.h.head(low.count).cwiseAbs().eval();
    if (sizes[0] < kDriftRise * sizes.minCoeff()) continue;
    std::vector<double> left =
        clear_errors(curve, relative_errors(data, modes, curve), noise_of(data, curve), low);
    if (!left.empty() && numerics::median(std::move(left)) > least) return true;
    // Drift is largest in the lower half.
    if (driving[c] &&
        gives_energy(curve_of(modes, curve, data.s), {0, std::max(kLeastLowEnd, low.count / 2)}))
      return true;
  }
  return false;
}

}  // namespace stablecut::modal
