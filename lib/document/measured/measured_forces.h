// Tables of mean cutting forces.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "document/kinds/cut_json.h"
#include "document/text/json_text.h"
#include "milling/force_identification.h"

namespace stablecut::document {

struct MeasuredForceRow {
  milling::MeasuredForce force;
  double speed_rpm = 0;  ///< 0 where the table does not say
  std::string record;    ///< name of a file with the force over the time; empty where the means are here
  std::string place;     ///< for messages
};

/// From CSV with a header: fx_n, fy_n, fz_n (those that were measured) or record; depth_mm;
/// feed_per_tooth_mm unless the cut has it; where they differ from the cut's, entry_deg with exit_deg, or
/// milling (up, down) with radial_immersion; where they are known, fx_std_n, fy_std_n, fz_std_n; speed_rpm
/// with records. Columns in any order and among others. `cut`: cutter, pitches, runout, and the defaults.
/// Throws DataError.
std::vector<MeasuredForceRow> measured_forces(const Source& source, const CutDocument& cut);

/// The mean forces of a record, CSV with time_s and fx_n, fy_n, fz_n (those that were measured), over as many
/// whole revolutions as it holds. Times in equal steps. Throws DataError.
std::array<std::optional<double>, 3> mean_of_record(const Source& source, double speed_rpm);

}  // namespace stablecut::document
