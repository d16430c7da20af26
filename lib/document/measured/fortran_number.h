// Numbers as Fortran writes them.
#pragma once

#include <optional>
#include <string_view>

namespace stablecut::document {

/// One number at the front of the text, which is cut off: with D for E, without any letter before an exponent
/// of three digits, and without a blank before a minus sign. Words for what is no finite number (NaN, Inf,
/// ****) give a NaN; nothing for another text.
std::optional<double> take_number(std::string_view& text);

}  // namespace stablecut::document
