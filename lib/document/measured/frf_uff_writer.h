// Frequency responses as a universal file.
#pragma once

#include <string>

#include "document/measured/universal_file_writer.h"
#include "dynamics/frequency_response.h"

namespace stablecut::document {

/// Dataset 164 for SI, then a dataset 58 for each entry. Directions x, y, z, at nodes where they have any
/// (`x@3`). Variances are lost, and coherences. Throws InvalidArgument for other directions and for entries
/// with positions.
std::string frf_to_universal_file(const dynamics::FrequencyResponse& frf, UniversalForm form);

}  // namespace stablecut::document
