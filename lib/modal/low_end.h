// Up to where a measurement's low end tells nothing: README.md, "The low end".
#pragma once

#include <Eigen/Core>
#include <optional>

#include "modal/tap_channels.h"

namespace stablecut::modal {

/// A low end reaches up to that part of the band at most.
inline constexpr double kLowEndShare = 3;
/// Drift rises towards 0 Hz by at least that factor over what follows it.
inline constexpr double kDriftRise = 2;

/// The frequency (Hz) at which |H| of a channel first rises on the way to a resonance, clear of noise and
/// taking energy, as no drift does; infinite where it never does. `hz` [lines].
double first_rise_hz(const Eigen::VectorXd& hz, const Channel& channel);

/// Up to where a channel's low end is in doubt, Hz.
struct LowEnd {
  double doubtful_hz = 0;  ///< noise or drift: windows that tell nothing while |H| falls
  double ruined_hz = 0;    ///< drift that is proved, 0 if none: by windows that give energy
};

/// Below `risen_hz`, where some channel shows a mode, and each on to where what falls like 1 / omega^2 is a
/// small share of |H|. Nothing where the low end is sound, or more than the lower third of the band is in
/// doubt.
std::optional<LowEnd> low_end_of(const Eigen::VectorXd& hz, const Channel& channel, double risen_hz);

}  // namespace stablecut::modal
