// Where the hammer's force rises out of the noise: README.md, "Pulses".
#pragma once

#include <vector>

#include "taps/record.h"

namespace stablecut::taps {

/// One stretch of force above the trigger level.
struct Pulse {
  Eigen::Index from = 0, to = 0;  ///< samples: the first above the level, one past the last
  Eigen::Index peak = 0;          ///< sample of the largest size
  double force_n = 0;             ///< there, with its sign, offset taken off

  Eigen::Index width() const { return to - from; }

  /// Samples on either side within which what the channel shows is the pulse's own: its edges, and what the
  /// filter in front of a converter rings.
  Eigen::Index reach() const;
};

struct ForcePulses {
  std::vector<Pulse> pulses;  ///< by time
  double level_n = 0;         ///< the trigger level
  double offset_n = 0;        ///< of the channel
  double noise_n = 0;         ///< standard deviation of the quiet part
};

/// The pulses of a record's force. A pulse has the sign of the largest one. `level_n` > 0: the trigger level
/// instead of the one that follows from the record's quiet part and from its excursions to the other side.
/// No pulse where nothing rises above the level.
ForcePulses force_pulses(const Eigen::VectorXd& force, double level_n = 0);

}  // namespace stablecut::taps
