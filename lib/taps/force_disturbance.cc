#include "taps/force_disturbance.h"

#include <algorithm>
#include <cmath>

#include "numerics/order_statistics.h"
#include "taps/averages.h"
#include "taps/hit_spectra.h"

namespace stablecut::taps {
namespace {

constexpr double kSurelyMore = 4;         // deviations of the mean power of the lines above that of noise
constexpr double kQuotientSquare = 1.08;  // of mean over median, its relative variance for one value a line
constexpr double kOwnRinging = 5e-4;      // of the force: what filters leave there of the pulse itself

// Median of the sum of that many squares of complex normal numbers of mean square 1 [Choi1994].
double median_of_sum(double count) {
  return count - 1.0 / 3 + 8 / (405 * count) + 184 / (25515 * count * count);
}

}  // namespace

bool force_disturbed(const std::vector<Record>& records, const HitSearch& search, Eigen::Index length,
                     Eigen::Index lines) {
  std::vector<HitSpectrum> pulses;
  Eigen::ArrayXd power = Eigen::ArrayXd::Zero(lines), away = power;
  for (const Hit& hit : search.hits) {
    if (hit.fault != HitFault::kNone) continue;
    const auto through = [&](ForceWindow window) {
      return force_spectrum(records[hit.record], hit, length, lines, search.offset_n[hit.record],
                            search.noise_n[hit.record], {0, window});
    };
    pulses.push_back(through(ForceWindow::kPulse));
    power += pulses.back().force.array().abs2();
    away += through(ForceWindow::kAway).force.array().abs2();
  }
  if (pulses.empty()) return false;
  const Eigen::Index used = lines_with_force(pulses);
  if (used == 0) return false;
  // Noise has the same power on most lines, whatever its level; what is no noise lies on few of them.
  const auto hits = static_cast<double>(pulses.size());
  const double noise = numerics::median({away.begin(), away.begin() + used}) * hits / median_of_sum(hits);
  const double deviation = std::sqrt(kQuotientSquare / (hits * static_cast<double>(used)));
  return away.head(used).mean() >
         noise * (1 + kSurelyMore * deviation) + kOwnRinging * kOwnRinging * power.head(used).mean();
}

}  // namespace stablecut::taps
