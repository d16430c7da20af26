// A `cut` whose coefficients were found from measured forces.
#pragma once

#include <array>

#include "document/text/json_text.h"
#include "milling/force_identification.h"

namespace stablecut::document {

struct IdentifiedCut {
  Json cut;  ///< the document that gave the rest; format and provenance do not matter
  milling::ForceIdentification found;  ///< without bounds: deviations, intervals and estimates
  /// As written, N/m2 and N/m: none where nothing is known.
  std::array<std::optional<double>, milling::kCoefficients> value;
  std::array<bool, milling::kCoefficients> held_at_zero{};
};

/// A coefficient's name in a cut, `kt_n_per_mm2`.
const char* coefficient_name(int coefficient);

/// The document without provenance.
Json identified_cut_to_json(const IdentifiedCut& identified);

}  // namespace stablecut::document
