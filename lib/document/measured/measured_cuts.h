// Tested cuts: depth, speed, and what was observed.
#pragma once

#include <optional>
#include <vector>

#include "document/text/json_text.h"
#include "milling/tested_cuts.h"

namespace stablecut::document {

struct MeasuredCut {
  double depth_mm = 0;
  double speed_rpm = 0;
  std::optional<bool> observed_stable;
};

/// From CSV (a header names depth_mm, speed_rpm and optionally observed, in any order and among others;
/// without one they are the first columns in that order) or from JSON: a list of {"depth_mm", "speed_rpm",
/// "observed"}, or an object with that list under "points". `document` is the parsed JSON, null for CSV.
/// Throws DataError.
std::vector<MeasuredCut> measured_cuts(const Source& source, const Json& document);

/// The same in the units of the numeric rooms.
std::vector<milling::TestedCut> tested_cuts(const std::vector<MeasuredCut>& cuts);

}  // namespace stablecut::document
