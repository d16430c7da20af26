// Kind `frf`: frequency responses.
#pragma once

#include "document/text/json_text.h"
#include "dynamics/frequency_response.h"

namespace stablecut::document {

/// Reads the document, which stands at `pointer` in its source. A direction with a sign ("-x") turns the
/// entry's sign and loses it. Throws DataError.
dynamics::FrequencyResponse frf_from_json(const Json& document, const Source& source,
                                          const std::string& pointer = "");

/// The document without provenance; variances, coherences and positions are written where they are known.
Json frf_to_json(const dynamics::FrequencyResponse& frf);

/// Throws DataError for responses through an exponential window, for whoever has no use for H(i omega +
/// decay).
void refuse_window(const dynamics::FrequencyResponse& frf, const Source& source,
                   const std::string& pointer = "");

/// `receptance`, `mobility`, `accelerance`.
const char* quantity_name(dynamics::Quantity quantity);
/// Of one of these words.
dynamics::Quantity quantity_from_name(const std::string& name);

/// Takes the sign off a direction's name: -1 for "-x", else 1.
double take_sign(std::string& direction);

/// `re` and `im` lists of a complex series.
Json complex_series(const Eigen::VectorXcd& values);

/// A list of numbers.
Json number_list(const Eigen::VectorXd& values);

}  // namespace stablecut::document
