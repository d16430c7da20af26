// Names that loggers give to columns of time, force and motion.
#pragma once

#include <optional>
#include <string>

#include "dynamics/frequency_response.h"

namespace stablecut::document {

enum class TapColumnKind { kTime, kForce, kResponse };

/// What a column's name tells.
struct TapColumnName {
  TapColumnKind kind = TapColumnKind::kTime;
  std::string direction;                       ///< with its sign, as -x; empty: not told
  std::string unit;                            ///< as written, without brackets; empty: not told
  std::optional<dynamics::Quantity> quantity;  ///< of a response, by its unit or its word
  bool unit_known = false;                     ///< a unit of time, force, motion or voltage
  double to_si = 1;                            ///< by the unit
  bool in_volts = false;                       ///< the unit is one of voltage; to_si takes it to V
};

/// `Time (s)`, `hammer [N]`, `acc_x (g)`, `-ay`, `force_n`, `x [m/s^2]`. Nothing for a name that does not
/// tell what the column holds.
std::optional<TapColumnName> tap_column_name(const std::string& field);

/// Factor of a unit of voltage to V; nothing for another text.
std::optional<double> voltage_unit(const std::string& text);

}  // namespace stablecut::document
