// The field `fit` of a modal table: what fit-modes says of its fit.
#pragma once

#include <array>
#include <string_view>

#include "document/text/json_text.h"
#include "dynamics/frequency_response.h"
#include "modal/fit.h"

namespace stablecut {

/// By ModeModel.
inline constexpr std::array<std::string_view, 3> kModelNames = {"nonsymmetric", "symmetric", "proportional"};

/// The fields of `fit`, without the covariance. `measured` is what was fitted.
document::Json fit_report(const modal::ModalFit& fit, const dynamics::FrequencyResponse& measured);

}  // namespace stablecut
