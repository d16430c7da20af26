// A `cut` whose Kt and Kr were learnt from cuts that were tried.
#pragma once

#include <vector>

#include "document/kinds/cut_json.h"
#include "document/measured/measured_cuts.h"
#include "milling/tested_coefficients.h"

namespace stablecut::document {

struct TestedCutDocument {
  Json cut;                       ///< the document of the prior; format and provenance do not matter
  CutDocument prior;              ///< the same, read
  std::vector<MeasuredCut> cuts;  ///< those that were observed
  milling::CoefficientPosterior posterior;
  milling::PosteriorRequest request;
};

/// The document without provenance.
Json tested_cut_to_json(const TestedCutDocument& document);

}  // namespace stablecut::document
