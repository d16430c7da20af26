// What a measurement shows about itself before anything is fitted: lines, channels and signs that cannot be
// right, and what they do to the modes.
#pragma once

#include <string>
#include <vector>

#include "dynamics/frequency_response.h"

namespace stablecut {

/// Findings on a receptance (m/N) with lines above 0 Hz, in words, one each: uneven lines; a band at either
/// end where integration or noise has ruined the data; dead channels; a driving point whose imaginary part
/// has the wrong sign (a swapped direction, another quantity), for Im H_ii <= 0 where a structure only takes
/// energy; H_ij = -H_ji; poor coherence, with the time between two hits where its dips tell; a peak that is
/// none of m/N. An entry of exact zeros is a dead channel where `zeros_are_dead`, else uncoupled.
std::vector<std::string> tap_findings(const FrequencyResponse& receptance, bool zeros_are_dead);

/// Lines on which single values stand out of the smooth curve through their neighbours in all entries that
/// are not zero, as mains hum does: more than a resonance that narrow could, which would show on the
/// neighbours too. Indices, increasing.
std::vector<Eigen::Index> disturbed_lines(const FrequencyResponse& receptance);

}  // namespace stablecut
