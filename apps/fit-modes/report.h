// What fit-modes says about a fit, as JSON.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "document/text/json_text.h"
#include "dynamics/frequency_response.h"
#include "modal/fit.h"
#include "modal/stabilization.h"

namespace stablecut {

/// By ModeModel.
inline constexpr std::array<std::string_view, 3> kModelNames = {"nonsymmetric", "symmetric", "proportional"};

/// The fields of `fit` in a modal table, without the covariance.
document::Json fit_report(const modal::ModalFit& fit, const dynamics::FrequencyResponse& measured);

/// A document of kind `stabilization`, with the modes that were chosen.
document::Json stabilization_to_json(const std::vector<modal::StabilizationOrder>& orders,
                                     const modal::ModalFit& fit, const dynamics::FrequencyResponse& measured);

}  // namespace stablecut
