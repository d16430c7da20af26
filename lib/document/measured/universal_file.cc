#include "document/measured/universal_file.h"

#include <utility>

#include "document/measured/fortran_number.h"
#include "document/measured/universal_lines.h"
#include "document/measured/universal_records.h"
#include "document/measured/universal_values.h"
#include "document/text/data_error.h"
#include "document/text/plain_text.h"

namespace stablecut::document {
namespace {

// Dataset 58 below its first line, up to its delimiter.
UniversalFunction read_function(const Source& source, LineReader& lines, const DatasetHeader& header,
                                int number) {
  const auto refuse = [&](const std::string& value, const std::string& expected) {
    throw DataError(source.name, line_place(lines.line()), value,
                    "expected " + expected + ", in function " + std::to_string(number));
  };
  // Some writers leave the format at 0.
  if (header.binary && header.float_format != 2 && header.float_format != 0)
    refuse("floating-point format " + std::to_string(header.float_format), "2, IEEE 754 (1 is VAX, 3 IBM)");
  if (header.binary && header.byte_order != 1 && header.byte_order != 2)
    refuse("byte order " + std::to_string(header.byte_order), "1 (little endian) or 2 (big)");
  UniversalFunction function;
  function.number = number;
  function.line = lines.line() + 1;
  const ValueLayout layout = read_records(source, lines, header, function);
  read_values(source, lines, header, layout, function);
  return function;
}

// Dataset 164: I10,20A1,I10; 3D25.17; D25.17. The lines up to the delimiter.
UniversalUnits read_units(const Source& source, LineReader& lines) {
  UniversalUnits units;
  const auto first = lines.next();
  const auto second = first ? lines.next() : std::nullopt;
  const auto fail = [&](std::string_view value) -> void {
    throw DataError(source.name, line_place(lines.line()), std::string(trimmed(value)),
                    "expected the factors of length and force in dataset 164, above 0");
  };
  if (!second) fail(first ? *first : "end of the file");
  std::string_view rest = *second;
  for (double* factor : {&units.length_factor, &units.force_factor}) {
    while (!rest.empty() && is_blank(rest.front())) rest.remove_prefix(1);
    const auto value = take_number(rest);
    if (!value || !(*value > 0 && *value < 1e30 && *value > 1e-30)) fail(*second);
    *factor = *value;
  }
  skip_dataset(lines);
  return units;
}

}  // namespace

bool looks_like_universal_file(std::string_view text) {
  constexpr long kLinesInFront = 50;
  LineReader lines(text);
  for (auto line = lines.next(); line && lines.line() <= kLinesInFront; line = lines.next()) {
    if (!is_delimiter(*line)) continue;
    const auto header = lines.next();
    return header && dataset_header(*header);
  }
  return false;
}

std::vector<UniversalFunction> read_universal_file(const Source& source) {
  LineReader lines(source.text);
  std::vector<UniversalFunction> functions;
  std::optional<UniversalUnits> units;
  int others = 0;
  // After a delimiter comes a dataset's number. A second delimiter opens a dataset after one has ended; where
  // it is missing, the first does.
  bool opened = false;
  while (const auto line = lines.next()) {
    if (is_delimiter(*line)) {
      opened = true;
      continue;
    }
    if (!opened || trimmed(*line).empty()) continue;
    opened = false;
    const auto header = dataset_header(*line);
    if (!header) continue;
    opened = true;
    if (header->number == 58) {
      functions.push_back(read_function(source, lines, *header, static_cast<int>(functions.size()) + 1));
      functions.back().units = units;
    } else if (header->number == 164) {
      units = read_units(source, lines);
      // Of a file that says its units at the end.
      for (UniversalFunction& function : functions) {
        if (!function.units) function.units = units;
      }
    } else {
      ++others;
      skip_dataset(lines);
    }
  }
  if (functions.empty()) {
    throw DataError(source.name, "", std::to_string(others + (units ? 1 : 0)) + " datasets, none of them 58",
                    "expected a universal file with functions, dataset 58");
  }
  return functions;
}

}  // namespace stablecut::document
