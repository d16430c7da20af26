// A holder or spindle that was tapped, or whose modes are known: its receptance at the joint.
#pragma once

#include <array>
#include <vector>

#include "dynamics/frequency_response.h"
#include "dynamics/modal_model.h"
#include "receptance/held_tool.h"

namespace stablecut::receptance {

/// Taps on the holder's face, or on a known part that stands on it.
struct HolderMeasurement {
  dynamics::FrequencyResponse frf;  ///< positions: distance inwards from the face, or from the artefact's tip
  double sensor_mass_kg = 0;        ///< of the accelerometer at each entry's response; taken away
  BeamChain artefact;               ///< from its tip to the face; empty: none
};

/// Where a direction's slopes come from.
enum class SlopeSource {
  kMeasured,          ///< the entries with slopes
  kFiniteDifference,  ///< l = n = (h(0) - h(S)) / S, p = l n / h or by the second difference
  kArtefact,          ///< three or more pairs of places on a known part: no difference is taken
};

/// What is known of a direction's quality.
struct HolderQuality {
  bool measured = false;  ///< there are entries in this direction
  SlopeSource slopes = SlopeSource::kMeasured;
  double spacing_m = 0;               ///< S of a finite difference
  bool second_difference = false;     ///< p by (h(0,0) - h(0,S) - h(S,0) + h(S,S)) / S^2; else of rank one
  std::vector<double> noisy_hz;       ///< lines on which l is below three standard deviations of its noise
  std::vector<double> unphysical_hz;  ///< lines on which more than 5 % of the receptance gives energy away
};

struct MeasuredHolder {
  std::vector<Receptance<4>> receptance;  ///< [lines] w_x, slope_x, w_y, slope_y; zero where not measured
  std::array<HolderQuality, 2> quality;   ///< in x and in y
  bool couples_directions = false;        ///< cross entries other than zero
  bool cross_left_out = false;            ///< there were some, but not what it takes to use them
};

/// The receptance at the face on the given lines: the measured ones, or between them by cubic interpolation.
///
/// Slopes are taken from entries with slopes; else by a finite difference of the places 0 and S. A sensor of
/// mass m at the response's place a made of the true H_ab what was measured: the true one is the measured one
/// over 1 + m w^2 H_aa, so that the direct receptance there must be among the entries. An artefact is taken
/// off by inverse coupling: taps at three or more pairs of its places say all of what holds it (G_ab = R_ab -
/// r_a (R22 + H)^-1 r_b is linear in the inverse, least squares when there are more), fewer go by the finite
/// difference at its tip. Entries between x and y count when both directions were measured, and hold both
/// ways where one was.
///
/// Throws InvalidArgument for lines outside the measured band and for entries that do not suffice.
MeasuredHolder measured_holder(const HolderMeasurement& measurement, BeamTheory theory,
                               const Eigen::VectorXd& frequency_hz);

/// The same from modes; the dofs x and slope_x, y and slope_y, at least one pair. Throws InvalidArgument.
MeasuredHolder modal_holder(const dynamics::ModalModel& model, const Eigen::VectorXd& frequency_hz);

}  // namespace stablecut::receptance
