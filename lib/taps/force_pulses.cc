#include "taps/force_pulses.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "numerics/order_statistics.h"

namespace stablecut::taps {
namespace {

constexpr double kFalseAlarm = 1e-3;     // chance that noise alone triggers somewhere in a record
constexpr double kMadOfNormal = 0.6745;  // median of the size of a normal number of deviation 1
constexpr double kOtherSide = 2;         // trigger level over the largest excursion to the other side
constexpr double kLeastPulse = 1e-3;     // of the largest: below, a second blow changes nothing that matters
constexpr double kMostLevel = 0.5;       // of the largest: that one is always found
constexpr Eigen::Index kFilterRings = 16;  // samples, twice: then a converter's filter rings above all lines

double median_of(const Eigen::VectorXd& values) {
  return numerics::median(std::vector<double>(values.begin(), values.end()));
}

// Gauss: noise of deviation 1 exceeds this once in 1 / kFalseAlarm records of that length, at most.
double highest_of_noise(Eigen::Index samples) {
  return std::sqrt(2 * std::log(static_cast<double>(samples) / kFalseAlarm));
}

}  // namespace

Eigen::Index Pulse::reach() const { return std::max(width(), kFilterRings); }

ForcePulses force_pulses(const Eigen::VectorXd& force, double level_n) {
  ForcePulses result;
  if (force.size() == 0) return result;
  result.offset_n = median_of(force);
  const Eigen::VectorXd centred = force.array() - result.offset_n;
  result.noise_n = median_of(centred.cwiseAbs()) / kMadOfNormal;
  const double sign = centred.maxCoeff() >= -centred.minCoeff() ? 1 : -1;
  const Eigen::VectorXd pushing = sign * centred;
  const double largest = pushing.maxCoeff(), other_side = -pushing.minCoeff();
  result.level_n = level_n;
  if (!(level_n > 0)) {
    const double noise_level = result.noise_n * highest_of_noise(force.size());
    if (!(largest > noise_level)) return result;
    result.level_n = std::max(
        noise_level, std::clamp(kOtherSide * other_side, kLeastPulse * largest, kMostLevel * largest));
  }
  for (Eigen::Index i = 0; i < pushing.size(); ++i) {
    if (!(pushing[i] > result.level_n)) continue;
    auto& pulses = result.pulses;
    // Noise may cross the level more than once: a gap shorter than the pulse is none.
    const bool begins = pulses.empty() || i - pulses.back().to > pulses.back().width();
    if (begins) pulses.push_back({i, i + 1, i, 0});
    Pulse& pulse = pulses.back();
    pulse.to = i + 1;
    if (begins || pushing[i] > pushing[pulse.peak]) pulse.peak = i;
    pulse.force_n = centred[pulse.peak];
  }
  return result;
}

}  // namespace stablecut::taps
