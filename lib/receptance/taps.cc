#include "receptance/taps.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <string>
#include <utility>

#include "base/error.h"
#include "base/number_text.h"
#include "base/units.h"
#include "dynamics/noise.h"

namespace stablecut::receptance {

const Tap* tap_at(const Taps& taps, int response, int reference, double response_m, double reference_m) {
  const auto found = std::find_if(taps.begin(), taps.end(), [&](const Tap& tap) {
    return tap.is_of(response, reference) && tap.is_at(response_m, reference_m);
  });
  return found == taps.end() ? nullptr : &*found;
}

std::vector<const Tap*> taps_of_coordinates(const Taps& taps, int response, int reference) {
  std::vector<const Tap*> result;
  for (const Tap& tap : taps) {
    if (tap.is_of(response, reference)) result.push_back(&tap);
  }
  return result;
}

Taps taps_of(const dynamics::FrequencyResponse& measured, const Eigen::VectorXd& frequency_hz) {
  // An acceleration at 0 Hz gives no receptance, and no assembly asks for that line.
  dynamics::FrequencyResponse frf = dynamics::to_receptance(dynamics::within_band(
      measured, std::numeric_limits<double>::min(), std::numeric_limits<double>::infinity()));
  if (frf.frequency_hz.size() == 0) throw InvalidArgument("no line above 0 Hz");
  for (auto& entry : frf.entries) {
    entry.variance = dynamics::weighing_variance(entry, frf.frequency_hz);
    if (entry.variance.size() == 0)
      entry.variance = dynamics::estimated_variance(frf.frequency_hz, entry.h, entry.h.cwiseAbs(),
                                                    dynamics::floor_shapes(frf.frequency_hz));
  }
  const dynamics::FrequencyResponse wanted = dynamics::on_lines(frf, frequency_hz);
  Taps taps;
  for (std::size_t e = 0; e < frf.entries.size(); ++e) {
    const auto& entry = wanted.entries[e];
    const auto coordinate = [](const std::string& name) {
      return static_cast<int>(std::find(kCoordinates.begin(), kCoordinates.end(), name) -
                              kCoordinates.begin());
    };
    Tap tap{coordinate(entry.response),
            coordinate(entry.reference),
            entry.response_position_m.value_or(0),
            entry.reference_position_m.value_or(0),
            entry.h,
            entry.variance,
            dynamics::doubtful_intervals(frf.frequency_hz, frf.entries[e].h, frf.entries[e].variance,
                                         frequency_hz)};
    if (tap.response < 4 && tap.reference < 4) taps.push_back(std::move(tap));
  }
  return taps;
}

void remove_sensor(Taps& taps, double mass_kg, const Eigen::VectorXd& frequency_hz) {
  const Taps measured = taps;
  for (Tap& tap : taps) {
    if (tap.has_slope())
      throw InvalidArgument("a sensor's mass can be taken away from deflections only, not from slopes");
    const double a = tap.response_m;
    const int other = 2 - tap.response;
    const auto curve = [&](int response, int reference, double reference_m) {
      const Tap* found = tap_at(measured, response, reference, a, reference_m);
      return found == nullptr ? Eigen::VectorXcd::Zero(tap.h.size()).eval() : found->h;
    };
    if (tap_at(measured, tap.response, tap.response, a, a) == nullptr) {
      throw InvalidArgument(std::string("the direct receptance ") + kCoordinates[tap.response] +
                            " at the sensor's place, " + number_text(1e3 * a) +
                            " mm: missing, and needed to take its mass away");
    }
    const Eigen::VectorXcd own = curve(tap.response, tap.response, a), away = curve(tap.response, other, a);
    const Eigen::VectorXcd back = curve(other, tap.response, a), across = curve(other, other, a);
    const Eigen::VectorXcd other_h = curve(other, tap.reference, tap.reference_m);
    for (Eigen::Index i = 0; i < tap.h.size(); ++i) {
      const double mw2 = mass_kg * std::pow(rad_per_s_from_hz(frequency_hz[i]), 2);
      const Eigen::Matrix2cd factor{{1.0 + mw2 * own[i], mw2 * away[i]},
                                    {mw2 * back[i], 1.0 + mw2 * across[i]}};
      const Eigen::Matrix2cd inverse = factor.inverse();
      tap.variance[i] *= std::norm(inverse(0, 0));
      tap.h[i] = inverse(0, 0) * tap.h[i] + inverse(0, 1) * other_h[i];
    }
  }
}

void complete_by_reciprocity(Taps& taps) {
  const std::size_t measured = taps.size();
  for (std::size_t i = 0; i < measured; ++i) {
    Tap mirrored = taps[i];
    std::swap(mirrored.response, mirrored.reference);
    std::swap(mirrored.response_m, mirrored.reference_m);
    const bool between_directions = mirrored.response / 2 != mirrored.reference / 2;
    if (between_directions && tap_at(taps, mirrored.response, mirrored.reference, mirrored.response_m,
                                     mirrored.reference_m) == nullptr)
      taps.push_back(std::move(mirrored));
  }
}

}  // namespace stablecut::receptance
