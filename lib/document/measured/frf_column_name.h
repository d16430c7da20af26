// Names that analysers give to columns of frequency responses.
#pragma once

#include <optional>
#include <string>

namespace stablecut::document {

/// What a column holds.
enum class ColumnPart { kFrequency, kReal, kImaginary, kMagnitude, kDecibel, kPhase, kCoherence };

/// What a column's name tells.
struct ColumnName {
  ColumnPart part = ColumnPart::kReal;
  std::string response, reference;  ///< empty: not told
  double sign = 1;
  std::string unit;  ///< as written, without brackets
};

/// `Hxy (imag) [m/N]`, `xx_re`, `Magnitude (dB)`, `f [kHz]`: the part, the directions, the unit. Nothing when
/// the name does not tell the part.
std::optional<ColumnName> column_name(const std::string& field);

}  // namespace stablecut::document
