// What a measurement shows about itself before anything is fitted: lines, channels and signs that cannot be
// right, and what they do to the modes.
#pragma once

#include <string>
#include <vector>

#include "dynamics/frequency_response.h"

namespace stablecut::modal {

struct TapReport {
  /// In words, one each: uneven lines; a band at either end where integration or noise has ruined the data;
  /// dead channels; a driving point whose imaginary part has the wrong sign (a swapped direction, another
  /// quantity), for Im H_ii <= 0 where a structure only takes energy; H_ij = -H_ji, or far from H_ji; poor
  /// coherence, with the time between two hits where its dips tell; a peak that is none of m/N.
  std::vector<std::string> findings;
  /// Lines on which an entry's single value stands out of its neighbours, as mains hum does: of a cubic
  /// through four of them, and of a resonance that eight of them could show. Indices, increasing.
  std::vector<Eigen::Index> disturbed_lines;
};

/// Looks at a receptance (m/N) with lines above 0 Hz. An entry of exact zeros is a dead channel where
/// `zeros_are_dead`, else uncoupled. Nothing is said of fewer than 20 lines.
TapReport check_tap(const dynamics::FrequencyResponse& receptance, bool zeros_are_dead);

}  // namespace stablecut::modal
