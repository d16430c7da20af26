// Loaded poses and how they gave way, as a spreadsheet's table.
#pragma once

#include <array>

#include "document/kinds/load_samples_json.h"

namespace stablecut::document {

/// The same as load_samples_from_json, from CSV. A header names the columns, in any order: the joints by the
/// robot's names or A1..A6, J1.., Q1..; Fx, Fy, Fz; Mx, My, Mz; dx, dy, dz; rx, ry, rz; std; std_rad;
/// force_point_x, measuring_point_x and so on; each may be followed by its unit, as in dx_um, "dx [um]" or
/// "dx (um)" (default: deg, N, N m, mm, rad). Without a header there are twelve columns: six joints in
/// degrees, force in N, deflection in mm. Components that are not in `components` may be missing. Throws
/// DataError with the line.
LoadSamplesDocument load_samples_from_csv(const Source& source, const robot::Robot& robot,
                                          const std::array<bool, 3>& components);

}  // namespace stablecut::document
