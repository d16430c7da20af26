// Kind `load-samples`: loaded poses and how they gave way, as JSON or as a spreadsheet's table.
#pragma once

#include <array>
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
};

/// Deflection components that are not in `components` may be null in JSON and missing in CSV. Points default
/// to the robot's tool point. Throws DataError; also where some samples state a deviation and others do not.
LoadSamplesDocument load_samples_from_json(const Json& document, const Source& source,
                                           const robot::Robot& robot, const std::array<bool, 3>& components);

/// The same from CSV. A header names the columns, in any order: the joints by the robot's names or A1..A6,
/// J1.., Q1..; Fx, Fy, Fz; Mx, My, Mz; dx, dy, dz; rx, ry, rz; std; std_rad; force_point_x, measuring_point_x
/// and so on; each may be followed by its unit, as in dx_um, "dx [um]" or "dx (um)". Without a header there
/// are twelve columns: six joints in degrees, force in N, deflection in mm. Throws DataError with the line.
LoadSamplesDocument load_samples_from_csv(const Source& source, const robot::Robot& robot,
                                          const std::array<bool, 3>& components);

}  // namespace stablecut::document
