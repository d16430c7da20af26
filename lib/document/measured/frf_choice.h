// What the user knows better than the file of a measurement.
#pragma once

#include <optional>
#include <vector>

#include "document/measured/frf_unit.h"

namespace stablecut::document {

/// The forms of a measurement: a frf document, a universal file, columns of text, and CutPro's .frf, which is
/// columns with the unit at the end of the first line.
enum class FrfForm { kJson, kUniversalFile, kColumns, kCutPro };

/// Each reader uses the members that its form has a use for.
struct FrfChoice {
  std::optional<FrfForm> form = {};                 ///< empty: by content
  std::optional<dynamics::Quantity> quantity = {};  ///< where the file does not tell it, or wrongly
  std::optional<FrfUnit> unit = {};                 ///< of the numbers; wins over what the file says
  std::vector<int> functions = {};                  ///< of a universal file, 1-based; empty: all
  std::optional<int> node = {};                     ///< only responses and forces at this node
  std::optional<double> averages = {};  ///< number of averages behind coherences, which files do not tell
};

}  // namespace stablecut::document
