#include "document/measured/universal_values.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "document/measured/fortran_number.h"
#include "document/text/data_error.h"
#include "document/text/plain_text.h"

namespace stablecut::document {
namespace {

constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();

void make_room(const ValueLayout& layout, UniversalFunction& function) {
  const Eigen::Index count = layout.count;
  function.values = Eigen::VectorXcd::Zero(count);
  function.abscissa.resize(count);
  if (!layout.even) return;
  for (Eigen::Index i = 0; i < count; ++i)
    function.abscissa[i] = layout.first + static_cast<double>(i) * layout.step;
}

// Number i of the values, in the order in which they are stored: [abscissa,] real[, imaginary].
void place_number(const ValueLayout& layout, UniversalFunction& function, std::size_t i, double value) {
  const Eigen::Index row = i / layout.width();
  std::size_t column = i % layout.width();
  if (!layout.even) {
    if (column == 0) {
      function.abscissa[row] = value;
      return;
    }
    --column;
  }
  auto& ordinate = function.values[row];
  column == 0 ? ordinate.real(value) : ordinate.imag(value);
}

std::string value_place(const LineReader& lines, const UniversalFunction& function) {
  return FilePlace{lines.line(), function.number, 12}.text();
}

void read_text(const Source& source, LineReader& lines, const ValueLayout& layout,
               UniversalFunction& function) {
  const std::size_t wanted = layout.numbers();
  // Each number takes a character at least: a count that the file cannot hold is refused before there is
  // room made for it.
  if (wanted > lines.rest().size()) {
    throw DataError(source.name, function.place(7).text(), std::to_string(layout.count),
                    "expected a number of values that the file holds");
  }
  make_room(layout, function);
  std::size_t got = 0;
  for (;;) {
    const auto line = lines.next();
    if (!line || is_delimiter(*line)) {
      if (got == wanted) return;
      throw DataError(
          source.name, value_place(lines, function), line ? "-1" : "end of the file",
          "expected " + std::to_string(wanted) + " numbers, as record 7 says, after " + std::to_string(got));
    }
    // What follows the last value (a filled-up line, further records) tells nothing.
    std::string_view rest = *line;
    while (got < wanted) {
      while (!rest.empty() && is_blank(rest.front())) rest.remove_prefix(1);
      if (rest.empty()) break;
      const auto value = take_number(rest);
      if (!value) {
        throw DataError(source.name, value_place(lines, function),
                        std::string(rest.substr(0, rest.find_first_of(kBlanks))), "expected a number");
      }
      place_number(layout, function, got++, *value);
    }
  }
}

// The number in 4 or 8 bytes; not a number where it is not finite.
double binary_number(const char* at, std::size_t size, bool big_endian) {
  std::array<char, 8> bytes{};
  std::memcpy(bytes.data(), at, size);
  if (big_endian != (std::endian::native == std::endian::big))
    std::reverse(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
  double value = 0;
  if (size == 4) {
    float single = 0;
    std::memcpy(&single, bytes.data(), size);
    value = static_cast<double>(single);
  } else {
    std::memcpy(&value, bytes.data(), size);
  }
  return std::isfinite(value) ? value : kNotANumber;
}

// True where a delimiter, or the end of the text, stands behind that many bytes.
bool ends_behind(std::string_view text, std::size_t bytes) {
  if (bytes > text.size()) return false;
  const std::string_view after = text.substr(bytes);
  const auto from = after.find_first_not_of(" \r\n\t");
  return from == std::string_view::npos || after.substr(from).starts_with("-1");
}

void read_binary(const Source& source, LineReader& lines, const DatasetHeader& header,
                 const ValueLayout& layout, UniversalFunction& function) {
  const std::string_view rest = lines.rest();
  // Writers differ in what an uneven abscissa takes in double precision, 8 bytes or 4: the length tells.
  const std::size_t number_bytes = layout.is_double ? 8 : 4;
  const std::size_t full = layout.numbers() * number_bytes;
  const std::size_t with_short_abscissa = full - (layout.even || !layout.is_double ? 0 : layout.count * 4);
  const bool short_abscissa = with_short_abscissa != full &&
                              header.bytes.value_or(full) == with_short_abscissa &&
                              ends_behind(rest, with_short_abscissa);
  const std::size_t bytes = short_abscissa ? with_short_abscissa : full;
  if (bytes > rest.size()) {
    throw DataError(source.name, value_place(lines, function), std::to_string(rest.size()) + " bytes",
                    "expected " + std::to_string(bytes) + ", as record 7 says");
  }
  // More bytes than the values take are fill, where the dataset ends behind them and not before.
  const std::size_t whole = std::max(bytes, ends_behind(rest, bytes) ? bytes : header.bytes.value_or(bytes));
  if (!ends_behind(rest, whole)) {
    throw DataError(source.name, value_place(lines, function),
                    std::to_string(header.bytes.value_or(0)) + " bytes",
                    "expected " + std::to_string(bytes) + " bytes of values, then -1");
  }
  make_room(layout, function);
  const char* at = rest.data();
  for (std::size_t i = 0; i < layout.numbers(); ++i) {
    const bool is_abscissa = !layout.even && i % layout.width() == 0;
    const std::size_t size = short_abscissa && is_abscissa ? 4 : number_bytes;
    place_number(layout, function, i, binary_number(at, size, header.byte_order == 2));
    at += size;
  }
  lines.skip(whole);
  skip_dataset(lines);
}

}  // namespace

void read_values(const Source& source, LineReader& lines, const DatasetHeader& header,
                 const ValueLayout& layout, UniversalFunction& function) {
  if (header.binary)
    read_binary(source, lines, header, layout, function);
  else
    read_text(source, lines, layout, function);
}

}  // namespace stablecut::document
