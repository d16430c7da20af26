// Numbers as Fortran writes them.
#pragma once

#include <optional>
#include <string_view>

namespace stablecut::document {

/// Takes one number off the front of the text. D and Q may stand for E, an exponent of three digits may stand
/// without a letter, and the next number may begin with its minus sign at once. Words that stand for no
/// finite number (NaN, Inf, ****) give a NaN. Nothing for any other text, which stays as it is.
std::optional<double> take_number(std::string_view& text);

}  // namespace stablecut::document
