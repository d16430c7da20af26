// Units as analysers write them: `(m/s²)/N`, `um/N`, `g/lbf`, `1/kg`.
#pragma once

#include <optional>
#include <string_view>

#include "dynamics/frequency_response.h"

namespace stablecut::document {

/// A unit by its dimensions and its size in SI.
struct PhysicalUnit {
  double to_si = 1;
  int length = 0, time = 0, force = 0;  ///< exponents; a mass is force time^2 / length
};

/// The unit in the text: names (m, um, in, g for 9.80665 m/s^2, s, N, lbf, kg, ...) with exponents, products
/// and quotients, in parentheses or brackets where wanted. Nothing when a name is unknown or the text is no
/// unit.
std::optional<PhysicalUnit> physical_unit(std::string_view text);

/// What a frequency response holds, and the factor to m/N, m/(N s) or m/(N s2).
struct FrfUnit {
  dynamics::Quantity quantity = dynamics::Quantity::kReceptance;
  double to_si = 1;
};

/// Nothing for a unit that is not a displacement, velocity or acceleration over a force.
std::optional<FrfUnit> frf_unit(const PhysicalUnit& unit);
std::optional<FrfUnit> frf_unit(std::string_view text);

/// Factor to Hz of Hz, kHz, rad/s, rpm; nothing for another text.
std::optional<double> frequency_unit(std::string_view text);

}  // namespace stablecut::document
