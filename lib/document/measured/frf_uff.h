// Frequency responses from a universal file's functions, and as such.
#pragma once

#include <string>
#include <vector>

#include "document/measured/frf_choice.h"
#include "document/measured/universal_file_writer.h"
#include "dynamics/frequency_response.h"

namespace stablecut::document {

/// All frequency responses of the file as one matrix, in SI, with the coherences that belong to them. A sign
/// of a direction turns the entry. Between several nodes a direction is named with its node, `x@3`. Functions
/// that are no frequency responses are left out with a remark that names function, record and line; where
/// none is left, the first of these is thrown as a DataError.
///
/// Units: dataset 164 where the file has one, else the unit labels, else SI; a label in g is believed.
dynamics::FrequencyResponse frf_from_universal_file(const Source& source, const FrfChoice& choice,
                                                    std::vector<std::string>& remarks);

/// Dataset 164 for SI, then a dataset 58 for each entry. Directions x, y, z, at nodes where they have any
/// (`x@3`). Variances are lost, and coherences. Throws InvalidArgument for other directions and for entries
/// with positions.
std::string frf_to_universal_file(const dynamics::FrequencyResponse& frf, UniversalForm form);

}  // namespace stablecut::document
