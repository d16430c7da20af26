// Document kind stabilization: the stabilization diagram of a fit. It is written only.
#pragma once

#include <vector>

#include "document/text/json_text.h"
#include "dynamics/frequency_response.h"
#include "dynamics/modal_model.h"
#include "modal/stabilization.h"

namespace stablecut::document {

/// Poles by order, the modes that were chosen (those in the band), and the mode indicator of the measurement,
/// a receptance.
Json stabilization_to_json(const std::vector<modal::StabilizationOrder>& orders,
                           const std::vector<dynamics::Mode>& chosen,
                           const dynamics::FrequencyResponse& measured);

}  // namespace stablecut::document
