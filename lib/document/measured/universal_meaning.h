// What a function of a universal file means: whether it is a frequency response, its quantity and its unit.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "document/measured/frf_choice.h"
#include "document/measured/remark.h"
#include "document/measured/universal_file.h"

namespace stablecut::document {

/// Gets what there is to remark.
using TakeRemark = std::function<void(Remark)>;

/// `function type 1, a time response`.
std::string function_type_text(int type);
/// `data type 12, Acceleration, m/s^2`.
std::string axis_text(const UniversalAxis& axis);

/// Why a function is to be left out, without the file's name; nothing for a frequency response or a coherence
/// that can be used.
std::optional<Remark> why_left_out(const UniversalFunction& function, const FrfChoice& choice);

/// Quantity of a frequency response, and the factor that takes its values to SI: what the user chose, else
/// dataset 164 where the file has one, else the unit labels, else SI. A label in g is believed.
FrfUnit meaning_of(const UniversalFunction& function, const FrfChoice& choice, const TakeRemark& remark);

/// Factor that takes its abscissa to Hz.
double factor_to_hz(const UniversalFunction& function, const TakeRemark& remark);

}  // namespace stablecut::document
