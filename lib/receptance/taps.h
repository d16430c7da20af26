// Measured receptances between places on a holder, or on a part that stands on it. README.md, section 7.
#pragma once

#include <cmath>
#include <vector>

#include "dynamics/frequency_response.h"
#include "dynamics/interpolation.h"
#include "receptance/beam.h"

namespace stablecut::receptance {

/// Measured places that differ by less than this (m) are one place.
inline constexpr double kSamePlace = 1e-9;

/// One measured curve: the response of a coordinate at one place to the load of a coordinate at another.
struct Tap {
  int response = 0, reference = 0;         ///< indices of kCoordinates
  double response_m = 0, reference_m = 0;  ///< distances from the face, or from the artefact's tip
  Eigen::VectorXcd h;                      ///< [lines] receptance
  Eigen::VectorXd variance;                ///< [lines] of the complex value, given or estimated
  std::vector<dynamics::DoubtfulInterval> doubtful =
      {};  ///< between measured lines, where `h` may be far off

  bool has_slope() const { return response % 2 == 1 || reference % 2 == 1; }
  bool is_of(int a, int b) const { return response == a && reference == b; }
  bool is_at(double a, double b) const {
    return std::abs(response_m - a) < kSamePlace && std::abs(reference_m - b) < kSamePlace;
  }
};

using Taps = std::vector<Tap>;

/// The tap of two coordinates at two places, or null.
const Tap* tap_at(const Taps& taps, int response, int reference, double response_m, double reference_m);

/// All taps of two coordinates.
std::vector<const Tap*> taps_of_coordinates(const Taps& taps, int response, int reference);

/// The measured entries whose directions are kCoordinates, as receptances on the given lines (Hz), with their
/// variances, estimated where the measurement says nothing. Throws InvalidArgument for lines outside the
/// measured band.
Taps taps_of(const dynamics::FrequencyResponse& measured, const Eigen::VectorXd& frequency_hz);

/// Takes away the mass m of the accelerometer at each response [Cakar2005]: H = (1 + m w^2 D)^-1 H_measured,
/// where D are the measured receptances of x and y at its place. Throws InvalidArgument where the direct
/// receptance there was not measured, and for slopes.
void remove_sensor(Taps& taps, double mass_kg, const Eigen::VectorXd& frequency_hz);

/// Adds what reciprocity gives: a tap between x and y that was measured one way only, the other way.
void complete_by_reciprocity(Taps& taps);

}  // namespace stablecut::receptance
