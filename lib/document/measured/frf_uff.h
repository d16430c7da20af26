// Frequency responses from a universal file's functions.
#pragma once

#include <vector>

#include "document/measured/frf_choice.h"
#include "document/measured/remark.h"
#include "document/text/json_text.h"
#include "dynamics/frequency_response.h"

namespace stablecut::document {

/// All frequency responses of the file as one matrix, in SI (see meaning_of), with the coherences that belong
/// to them. A sign of a direction turns the entry. Between several nodes a direction is named with its node,
/// `x@3`. Functions that are no frequency responses are left out with a remark; where none is left, the first
/// of these is thrown as a DataError.
dynamics::FrequencyResponse frf_from_universal_file(const Source& source, const FrfChoice& choice,
                                                    std::vector<Remark>& remarks);

}  // namespace stablecut::document
