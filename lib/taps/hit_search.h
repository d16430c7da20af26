// Hits in records of hammer and response, and which of them are of no use: README.md, "Hits".
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "taps/force_pulses.h"
#include "taps/record.h"

namespace stablecut::taps {

/// Why a hit is left out. The first that holds, in this order.
enum class HitFault {
  kNone,
  kDouble,    ///< a second blow `seconds` before or after
  kOverload,  ///< `channel` was cut off: 0 the force, from 1 on the responses
  kWeak,      ///< far below the others' force
  kShort      ///< only `seconds` until the next hit, or the record's end
};

struct Hit {
  std::size_t record = 0;  ///< index
  Pulse pulse;
  Eigen::Index from = 0;  ///< sample at which its part of the record begins
  HitFault fault = HitFault::kNone;
  double seconds = 0;
  std::size_t channel = 0;
};

struct HitChoice {
  std::optional<double> trigger_n;      ///< level of force instead of the record's own
  std::optional<double> length_s;       ///< of each hit's part, instead of the longest that most allow
  std::optional<double> pre_trigger_s;  ///< from a part's beginning to its pulse, at most
};

struct HitSearch {
  std::vector<Hit> hits;         ///< all of them, by record and time
  Eigen::Index length = 0;       ///< samples of each hit's part; 0 without a hit
  std::vector<double> noise_n;   ///< [records] deviation of the force's noise
  std::vector<double> offset_n;  ///< [records] of the force's channel
};

/// The hits of records that were sampled at one rate.
HitSearch find_hits(const std::vector<Record>& records, const HitChoice& choice = {});

}  // namespace stablecut::taps
