// What stands before the values of a dataset 58: its first line, and records 1 to 11.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "document/measured/universal_file.h"
#include "document/measured/universal_lines.h"

namespace stablecut::document {

/// The first line of a dataset: `58`, or `58b` with what its binary form needs.
struct DatasetHeader {
  int number = 0;
  bool binary = false;
  int byte_order = 1;    ///< 1 little endian, 2 big
  int float_format = 2;  ///< 1 VAX, 2 IEEE 754, 3 IBM
  int header_lines = kUniversalHeaderRecords;
  std::optional<std::size_t> bytes;  ///< of the values, where the line tells
};

/// Nothing for a line that does not begin with a dataset's number.
std::optional<DatasetHeader> dataset_header(std::string_view line);

/// How the values of a function are stored (record 7).
struct ValueLayout {
  std::size_t count = 0;  ///< abscissas
  bool is_complex = false, is_double = false;
  bool even = true;            ///< the abscissa is first + i step; else it is stored before each value
  double first = 0, step = 0;  ///< of an even abscissa

  std::size_t ordinates() const { return is_complex ? 2 : 1; }
  /// Numbers stored for each abscissa.
  std::size_t width() const { return ordinates() + (even ? 0 : 1); }
  std::size_t numbers() const { return count * width(); }
};

/// Reads records 1 to 11 into the function, whose number and line are known, and further lines that a binary
/// header announces. Throws DataError with line, function and record.
ValueLayout read_records(const Source& source, LineReader& lines, const DatasetHeader& header,
                         UniversalFunction& function);

}  // namespace stablecut::document
