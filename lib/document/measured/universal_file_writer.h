// Universal files as text or bytes.
#pragma once

#include <string>

#include "document/measured/universal_file.h"

namespace stablecut::document {

/// How numbers are written.
enum class UniversalForm {
  kText,   ///< dataset 58: 13 digits a value, 11 for the first abscissa and the step
  kBinary  ///< dataset 58b: IEEE 754 doubles, little endian
};

/// Dataset 164 for SI.
std::string universal_si_units();
/// One dataset 58 or 58b with complex values in double precision. Equally spaced lines are written as such
/// where that gives the same lines again (of text: to its digits).
std::string universal_function(const UniversalFunction& function, UniversalForm form);

}  // namespace stablecut::document
