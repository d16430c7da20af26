// Universal files (SDRC I-DEAS): dataset 58, functions at nodal degrees of freedom, in text and in binary
// (58b), and dataset 164, units. Other datasets are passed over.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "document/measured/remark.h"
#include "document/text/json_text.h"

namespace stablecut::document {

/// Records before the values.
inline constexpr int kUniversalHeaderRecords = 11;

/// The numbers by which dataset 58 tells function types and data types, of those that matter here.
namespace universal {
// Function types, record 6.
inline constexpr int kGeneral = 0, kFrequencyResponse = 4, kCoherence = 6;
// Data types, records 8 to 10. 0 (unknown) and 1 (general) do not say what an axis holds.
inline constexpr int kLastUnspecific = 1, kDisplacement = 8, kReactionForce = 9, kVelocity = 11,
                     kAcceleration = 12, kForce = 13, kTime = 17, kFrequency = 18;
}  // namespace universal

/// Records 8 to 11: what an axis holds.
struct UniversalAxis {
  int data_type = 0;
  std::string label;  ///< `NONE` and blanks are empty
  std::string unit;   ///< likewise
};

/// A nodal degree of freedom: a node and a direction, 0 none, 1 to 3 along x, y, z, 4 to 6 about them,
/// negative against them.
struct UniversalDof {
  std::string entity;
  int node = 0;
  int direction = 0;

  bool is_translation() const { return direction >= -3 && direction <= 3; }
};

/// Dataset 164: a number in the file divided by its factor is in SI.
struct UniversalUnits {
  double length_factor = 1;
  double force_factor = 1;
};

/// One dataset 58.
struct UniversalFunction {
  int number = 0;  ///< 1-based among the file's functions
  long line = 0;   ///< of record 1; record r (up to 11) is on line + r - 1
  std::array<std::string, 5> id;
  int type = 0;
  UniversalDof response, reference;
  bool is_complex = false;
  Eigen::VectorXd abscissa;  ///< [values] as written
  Eigen::VectorXcd values;   ///< [values] as written; not a number where the file says so
  UniversalAxis abscissa_axis, ordinate, denominator;
  std::optional<UniversalUnits> units;  ///< the last dataset 164 before it, else the first behind it

  FilePlace place(int record) const { return {line + record - 1, number, record}; }
};

/// The functions of the file, in its order. Throws DataError with line, function and record for what cannot
/// be read, and for a file without a dataset 58.
std::vector<UniversalFunction> read_universal_file(const Source& source);

/// True for a text that has a line -1 near its beginning, and a dataset's number below it.
bool looks_like_universal_file(std::string_view text);

}  // namespace stablecut::document
