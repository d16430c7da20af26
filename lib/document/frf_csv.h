// Frequency responses from columns: Hz, then real and imaginary part of each entry.
#pragma once

#include "document/json_text.h"
#include "dynamics/frequency_response.h"

namespace stablecut {

/// Without a header, 3 columns are the entry xx, 9 columns xx, xy, yx, yy. With a header, each pair of
/// columns is named by its directions and part, as in `frequency_hz, xx_re, xx_im, Hxy real, Hxy imag`.
/// Throws DataError with the line.
FrequencyResponse frf_from_csv(const Source& source, Quantity quantity);

}  // namespace stablecut
