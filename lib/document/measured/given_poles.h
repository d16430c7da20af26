// Poles that are known, for a fit: a modal table, or columns of frequencies and damping ratios.
#pragma once

#include <vector>

#include "document/text/json_text.h"
#include "modal/fit.h"

namespace stablecut::document {

/// Of a modal-table document, each with the directions in which its mode is not zero; else of a table with a
/// header that names the columns `frequency_hz` and `damping_ratio`. Throws DataError.
std::vector<modal::GivenPole> given_poles(const Input& input);

}  // namespace stablecut::document
