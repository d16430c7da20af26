// Whether a force channel needs a force window: README.md, "Spectra".
#pragma once

#include <vector>

#include "taps/hit_search.h"
#include "taps/record.h"

namespace stablecut::taps {

/// Whether the force channel shows more than noise away from the hits' pulses (an undershoot, an offset that
/// drifts), on those of the first `lines` lines on which the hits have force. False without a hit that is
/// used.
bool force_disturbed(const std::vector<Record>& records, const HitSearch& search, Eigen::Index length,
                     Eigen::Index lines);

}  // namespace stablecut::taps
