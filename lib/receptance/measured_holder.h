// A holder or spindle that was tapped, or whose modes are known: its receptance at the joint. README.md,
// sections 7 to 10.
#pragma once

#include <array>
#include <vector>

#include "dynamics/frequency_response.h"
#include "dynamics/interpolation.h"
#include "dynamics/modal_model.h"
#include "receptance/held_tool.h"

namespace stablecut::receptance {

/// Taps on the holder's face, or along a known part that stands on it.
struct HolderMeasurement {
  dynamics::FrequencyResponse frf;  ///< positions: distance inwards from the face, or from the artefact's tip
  double sensor_mass_kg = 0;        ///< of the accelerometer, which sat at each entry's response place
  BeamChain artefact;               ///< the known part, from its tip to the face; empty: none
};

/// How a direction's slopes were obtained.
enum class SlopeSource {
  kMeasured,          ///< from entries with slopes
  kFiniteDifference,  ///< l = (h(0,0) - h(0,S)) / S, n = (h(0,0) - h(S,0)) / S; see second_difference for p
  kArtefact,          ///< from three or more pairs of places on a known part; no difference is taken
};

/// Standard deviations of its noise below which l counts as noisy.
inline constexpr double kNoisyDeviations = 3;
/// Of the receptance: the energy that a load may draw from the holder unremarked.
inline constexpr double kPassiveShare = 0.05;

/// What is known of the quality of one direction.
struct HolderQuality {
  bool measured = false;  ///< there are entries in this direction
  SlopeSource slopes = SlopeSource::kMeasured;
  double spacing_m = 0;               ///< S of a finite difference
  bool second_difference = false;     ///< p = (h(0,0) - h(0,S) - h(S,0) + h(S,S)) / S^2; else p = l n / h
  std::vector<double> noisy_hz;       ///< lines on which |l| is below kNoisyDeviations of its noise
  std::vector<double> unphysical_hz;  ///< lines on which a load would draw more than kPassiveShare

  /// Where measured lines are so far apart that the receptance between them may be far off: of all taps
  /// of this direction the largest errors, increasing.
  std::vector<dynamics::DoubtfulInterval> doubtful;

  /// Whether there is something to say: a difference was taken, or lines are noisy, unphysical or too far
  /// apart.
  bool limited() const {
    return slopes == SlopeSource::kFiniteDifference || !noisy_hz.empty() || !unphysical_hz.empty() ||
           !doubtful.empty();
  }
};

struct MeasuredHolder {
  std::vector<Receptance<4>> receptance;  ///< [lines] w_x, slope_x, w_y, slope_y; zero where not measured
  std::array<HolderQuality, 2> quality;   ///< in x and in y
  bool couples_directions = false;        ///< some entry between x and y is not zero
  bool cross_left_out = false;            ///< entries between x and y were measured, but too few to be of use
};

/// The receptance at the face on the given lines (Hz): the measured one, or between measured lines that of a
/// cubic. The sensor's mass is taken away first (taps.h). Without an artefact slopes are measured ones or
/// finite differences (slopes.h). Taps at three or more pairs of places on an artefact give what holds it
/// (artefact.h); fewer give slopes at its tip by finite differences, and the artefact is then taken off by
/// inverse coupling (coupling.h). Entries between x and y count when both directions were measured; one way
/// is enough.
///
/// Throws InvalidArgument for lines outside the measured band and for entries that do not suffice.
MeasuredHolder measured_holder(const HolderMeasurement& measurement, BeamTheory theory,
                               const Eigen::VectorXd& frequency_hz);

/// The same from modes with the dofs x and slope_x, y and slope_y, or one of these pairs. Throws
/// InvalidArgument for other dofs.
MeasuredHolder modal_holder(const dynamics::ModalModel& model, const Eigen::VectorXd& frequency_hz);

}  // namespace stablecut::receptance
