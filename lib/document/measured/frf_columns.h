// Frequency responses from columns of text: CSV, TSV, CutPro's .frf.
#pragma once

#include <vector>

#include "document/measured/frf_choice.h"
#include "document/measured/remark.h"
#include "document/text/json_text.h"
#include "dynamics/frequency_response.h"

namespace stablecut::document {

/// Frequency, then real and imaginary part of each entry, in SI. Without a header 3 columns are the entry xx,
/// 9 columns xx, xy, yx, yy. A header names the columns, as in `f_hz, xx_re, xx_im`, `Hxy real, Hxy imag`,
/// `Magnitude (um/N), Phase (deg)`, `Re[m/N]`, `coherence`; units may stand in it, in a row of their own
/// below it, or at the end of the first line (.frf). Lines before the header are passed over. Throws
/// DataError with the line.
dynamics::FrequencyResponse frf_from_columns(const Source& source, const FrfChoice& choice,
                                             std::vector<Remark>& remarks);

}  // namespace stablecut::document
