// How much an exponential window has to take off records that end before the structure is still: README.md,
// "The exponential window".
#pragma once

#include <vector>

#include "taps/hit_search.h"
#include "taps/record.h"

namespace stablecut::taps {

/// The least decay, 1/s, with which what still rings at the end of the hits' parts leaks less than the noise
/// of the average into any line; 0 where nothing does, and without hits. `hits` are those that are used.
double needed_decay(const std::vector<Record>& records, const std::vector<Hit>& hits, Eigen::Index length);

}  // namespace stablecut::taps
