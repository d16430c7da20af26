// Frequency responses from columns of text: CSV, TSV, CutPro's .frf.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "document/measured/frf_unit.h"
#include "document/text/json_text.h"
#include "dynamics/frequency_response.h"

namespace stablecut::document {

/// What the user knows better than the file.
struct ColumnChoice {
  std::optional<dynamics::Quantity> quantity = {};  ///< of the numbers, in SI (default: receptance)
  std::optional<FrfUnit> unit = {};                 ///< of the numbers; wins over what the file says
  std::optional<double> averages = {};              ///< behind a column of coherences
  bool needs_unit = false;                          ///< a .frf: the unit at the end of the first line
};

/// Frequency, then real and imaginary part of each entry, in SI. Without a header 3 columns are the entry xx,
/// 9 columns xx, xy, yx, yy. A header names the columns, as in `f_hz, xx_re, xx_im`, `Hxy real, Hxy imag`,
/// `Magnitude (um/N), Phase (deg)`, `Re[m/N]`, `coherence`; units may stand in it, in a row of their own
/// below it, or at the end of the first line (.frf). Lines before the header are passed over. Throws
/// DataError with the line.
dynamics::FrequencyResponse frf_from_columns(const Source& source, const ColumnChoice& choice,
                                             std::vector<std::string>& remarks);

}  // namespace stablecut::document
