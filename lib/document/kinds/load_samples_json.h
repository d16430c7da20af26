// Kind `load-samples`: loaded poses and how they gave way.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "document/text/json_text.h"
#include "robot/load_sample.h"

namespace stablecut::document {

/// Bounds of what a sample may hold, SI: N or N m, m, rad, and the least deviation (m or rad).
inline constexpr double kLargestLoad = 1e9, kLargestLength = 1e3, kLargestAngle = 175,
                        kLeastDeviation = 1e-15;

struct LoadSamplesDocument {
  std::vector<robot::LoadSample> samples;
  std::vector<std::string> places;  ///< JSON pointer or line of each, for messages
  std::vector<std::string> names;   ///< of each; empty where it has none
  /// What the file says that deflections are in, m, and forces, N; nothing where components differ.
  std::optional<double> deflection_unit_m = 1e-3, force_unit_n = 1;
};

/// Deflection components that are not in `components` may be null. Points default to the robot's tool point.
/// Throws DataError; also where some samples state a deviation and others do not.
LoadSamplesDocument load_samples_from_json(const Json& document, const Source& source,
                                           const robot::Robot& robot, const std::array<bool, 3>& components);

}  // namespace stablecut::document
