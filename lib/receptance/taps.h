// Measured curves between places on a holder or on a part that stands on it.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "dynamics/frequency_response.h"

namespace stablecut::receptance {

/// The coordinates of a Receptance<4>, by their names in documents.
inline constexpr std::array<const char*, 4> kCoordinates = {"x", "slope_x", "y", "slope_y"};

/// Places nearer than this (m) are one.
inline constexpr double kSamePlace = 1e-9;

/// One measured curve between two places.
struct Tap {
  int response = 0, reference = 0;         ///< of kCoordinates
  double response_m = 0, reference_m = 0;  ///< distances from the tip
  Eigen::VectorXcd h;                      ///< [lines] receptance
  Eigen::VectorXd variance;                ///< [lines] of the complex value, given or estimated

  bool slope() const { return response % 2 == 1 || reference % 2 == 1; }
  bool between(int a, int b) const { return response == a && reference == b; }
  bool at(double a, double b) const {
    return std::abs(response_m - a) < kSamePlace && std::abs(reference_m - b) < kSamePlace;
  }
};

using Taps = std::vector<Tap>;

/// Null when there is none.
const Tap* find(const Taps& taps, int response, int reference, double response_m, double reference_m);

std::vector<const Tap*> taps_between(const Taps& taps, int response, int reference);

/// The entries between kCoordinates on the given lines (Hz). Throws InvalidArgument for lines outside the
/// measured band.
Taps taps_of(const dynamics::FrequencyResponse& measured, const Eigen::VectorXd& frequency_hz);

/// Takes away the mass of the sensor at each response: H = (1 + m w^2 D)^-1 H_measured, D the measured direct
/// receptances (x and y) at its place. Throws InvalidArgument where the direct one is missing, and for
/// slopes.
void remove_sensor(Taps& taps, double mass_kg, const Eigen::VectorXd& frequency_hz);

/// Between directions, what was measured one way only holds the other way as well.
void complete_by_reciprocity(Taps& taps);

}  // namespace stablecut::receptance
