// The values of a dataset 58, in text or in binary.
#pragma once

#include "document/measured/universal_records.h"

namespace stablecut::document {

/// Reads the values into the function whose records have been read, and on to the delimiter behind them.
/// Throws DataError with line, function and record 12.
void read_values(const Source& source, LineReader& lines, const DatasetHeader& header,
                 const ValueLayout& layout, UniversalFunction& function);

}  // namespace stablecut::document
