#include "document/measured/universal_file.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "base/range.h"
#include "document/measured/fortran_number.h"
#include "document/text/data_error.h"
#include "document/text/plain_text.h"

namespace stablecut::document {
namespace {

constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  for (;;) {
    line = trimmed(line);
    if (line.empty()) return words;
    const auto end = line.find_first_of(kBlanks);
    words.push_back(line.substr(0, end));
    if (end == std::string_view::npos) return words;
    line.remove_prefix(end);
  }
}

// Columns `from` to `to` of a record, 1-based, both in.
std::string_view columns(std::string_view line, std::size_t from, std::size_t to) {
  return from > line.size() ? std::string_view() : line.substr(from - 1, to - from + 1);
}

// A blank field is 0, as Fortran reads it.
std::optional<int> field_integer(std::string_view field) {
  field = trimmed(field);
  return field.empty() ? std::optional(0) : parse_integer(field);
}

std::string name_of(std::string_view field) {
  const std::string name(trimmed(field));
  return lower(name) == "none" ? "" : name;
}

// The text line by line.
class LineReader {
 public:
  explicit LineReader(std::string_view text) : rest_(text) {
    if (rest_.starts_with("\xEF\xBB\xBF")) rest_.remove_prefix(3);  // a byte-order mark
  }

  long line() const { return line_; }  // of the line that next() gave last

  std::optional<std::string_view> next() {
    if (rest_.empty()) return std::nullopt;
    const auto end = rest_.find('\n');
    const std::string_view line = rest_.substr(0, end);
    rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
    ++line_;
    return line;
  }

  std::string_view rest() const { return rest_; }
  // Passes over that many bytes, counting their lines.
  void skip(std::size_t bytes) {
    const std::string_view passed = rest_.substr(0, bytes);
    line_ += std::count(passed.begin(), passed.end(), '\n');
    rest_.remove_prefix(passed.size());
  }

 private:
  std::string_view rest_;
  long line_ = 0;
};

bool is_delimiter(std::string_view line) { return trimmed(line) == "-1"; }

// What stands on the first line of a dataset: `58`, or `58b` with what its binary form needs.
struct DatasetHeader {
  int number = 0;
  bool binary = false;
  int byte_order = 1;    // 1 little endian, 2 big
  int float_format = 2;  // 1 VAX, 2 IEEE 754, 3 IBM
  int header_lines = kUniversalHeaderRecords;
  std::optional<std::size_t> bytes;
};

std::optional<DatasetHeader> dataset_header(std::string_view line) {
  std::vector<std::string_view> words = words_of(line);
  if (words.empty()) return std::nullopt;
  DatasetHeader header;
  header.binary = words[0].ends_with('b') || words[0].ends_with('B');
  if (header.binary) words[0].remove_suffix(1);
  const auto number = parse_integer(words[0]);
  if (!number || *number < 1) return std::nullopt;
  header.number = *number;
  if (!header.binary) return header;
  const auto word = [&](std::size_t i) { return i < words.size() ? parse_integer(words[i]) : std::nullopt; };
  header.byte_order = word(1).value_or(1);
  header.float_format = word(2).value_or(2);
  header.header_lines = word(3).value_or(kUniversalHeaderRecords);
  if (const auto bytes = word(4); bytes && *bytes > 0) header.bytes = static_cast<std::size_t>(*bytes);
  return header;
}

// How the numbers of a function are stored.
struct Layout {
  std::size_t count = 0;  // abscissas
  bool is_complex = false, is_double = false, even = true;
  double first = 0, step = 0;

  std::size_t ordinates() const { return is_complex ? 2 : 1; }
  std::size_t numbers() const { return count * (ordinates() + (even ? 0 : 1)); }
};

class DatasetReader {
 public:
  DatasetReader(const Source& source, LineReader& lines, const DatasetHeader& header, int number)
      : source_(source), lines_(lines), header_(header) {
    function_.number = number;
    function_.line = lines.line() + 1;
  }

  UniversalFunction read(const std::optional<UniversalUnits>& units) {
    function_.units = units;
    if (header_.binary && header_.float_format != 2 && header_.float_format != 0) {
      throw DataError(source_.name, line_place(lines_.line()),
                      "floating-point format " + std::to_string(header_.float_format),
                      "expected 2, IEEE 754 (1 is VAX, 3 IBM), in function " + std::to_string(number()));
    }
    if (header_.binary && header_.byte_order != 1 && header_.byte_order != 2) {
      throw DataError(source_.name, line_place(lines_.line()),
                      "byte order " + std::to_string(header_.byte_order),
                      "expected 1 (little endian) or 2 (big), in function " + std::to_string(number()));
    }
    for (int record = 1; record <= kUniversalHeaderRecords; ++record) read_record(record, next_line(record));
    for (int line = kUniversalHeaderRecords; header_.binary && line < header_.header_lines; ++line)
      next_line(line + 1);
    header_.binary ? read_binary() : read_text();
    return std::move(function_);
  }

 private:
  int number() const { return function_.number; }

  [[noreturn]] void fail(int record, std::string_view value, const std::string& expected) const {
    throw DataError(source_.name, function_.place(record), std::string(trimmed(value)), expected);
  }

  std::string_view next_line(int record) {
    const auto line = lines_.next();
    if (!line || (record > 5 && is_delimiter(*line))) {
      throw DataError(source_.name, function_.place(record), line ? "-1" : "end of the file",
                      "expected record " + std::to_string(record) + " of dataset 58");
    }
    return *line;
  }

  void read_record(int record, std::string_view line) {
    if (record <= 5) {
      function_.id[record - 1] = name_of(line);
    } else if (record == 6) {
      read_places(line);
    } else if (record == 7) {
      read_layout(line);
    } else if (record <= 10) {
      UniversalAxis& axis = record == 8   ? function_.abscissa_axis
                            : record == 9 ? function_.ordinate
                                          : function_.denominator;
      axis = read_axis(record, line);
    }
  }

  // 2(I5,I10),2(1X,10A1,I10,I4). Writers shift the columns; ten words are unambiguous.
  void read_places(std::string_view line) {
    const std::vector<std::string_view> words = words_of(line);
    std::array<std::optional<int>, 8> numbers;
    std::array<std::string_view, 2> names;
    if (words.size() == 10) {
      for (std::size_t i = 0; i < 4; ++i) numbers[i] = parse_integer(words[i]);
      for (std::size_t side = 0; side < 2; ++side) {
        names[side] = words[4 + 3 * side];
        for (std::size_t i = 0; i < 2; ++i)
          numbers[4 + 2 * side + i] = parse_integer(words[5 + 3 * side + i]);
      }
    }
    const auto all = [&] {
      return std::all_of(numbers.begin(), numbers.end(), [](auto& n) { return n.has_value(); });
    };
    if (!all()) {
      names = {columns(line, 32, 41), columns(line, 57, 66)};
      constexpr std::array<std::array<std::size_t, 2>, 8> kPlaces = {
          {{1, 5}, {6, 15}, {16, 20}, {21, 30}, {42, 51}, {52, 55}, {67, 76}, {77, 80}}};
      for (std::size_t i = 0; i < numbers.size(); ++i)
        numbers[i] = field_integer(columns(line, kPlaces[i][0], kPlaces[i][1]));
    }
    if (!all())
      fail(6, line, "expected a function type, and a name, a node and a direction of response and reference");
    function_.type = *numbers[0];
    function_.response = {name_of(names[0]), *numbers[4], *numbers[5]};
    function_.reference = {name_of(names[1]), *numbers[6], *numbers[7]};
  }

  // 3I10,3E13.5.
  void read_layout(std::string_view line) {
    const std::vector<std::string_view> words = words_of(line);
    std::array<std::optional<int>, 3> integers;
    std::array<std::optional<double>, 2> numbers;
    const auto whole = [](std::string_view text) -> std::optional<double> {
      const auto value = take_number(text);
      return text.empty() ? value : std::nullopt;
    };
    const auto all = [&] { return integers[0] && integers[1] && integers[2] && numbers[0] && numbers[1]; };
    if (words.size() >= 5) {
      for (std::size_t i = 0; i < 3; ++i) integers[i] = parse_integer(words[i]);
      for (std::size_t i = 0; i < 2; ++i) numbers[i] = whole(words[3 + i]);
    }
    if (!all()) {
      for (std::size_t i = 0; i < 3; ++i) integers[i] = field_integer(columns(line, 1 + 10 * i, 10 + 10 * i));
      for (std::size_t i = 0; i < 2; ++i) {
        const std::string_view field = trimmed(columns(line, 31 + 13 * i, 43 + 13 * i));
        numbers[i] = field.empty() ? std::optional(0.0) : whole(field);
      }
    }
    if (!all())
      fail(7, line,
           "expected the data type, the number of values, the spacing, the first abscissa and its step");
    const int type = *integers[0];
    if (type != 2 && type != 4 && type != 5 && type != 6) {
      fail(7, std::to_string(type), "expected an ordinate data type 2, 4 (real), 5 or 6 (complex)");
    }
    if (*integers[1] < 1) fail(7, std::to_string(*integers[1]), "expected a number of values above 0");
    if (*integers[2] != 0 && *integers[2] != 1) {
      fail(7, std::to_string(*integers[2]), "expected an abscissa spacing 0 (uneven) or 1 (even)");
    }
    layout_.count = static_cast<std::size_t>(*integers[1]);
    layout_.is_complex = function_.is_complex = type >= 5;
    layout_.is_double = type == 4 || type == 6;
    layout_.even = *integers[2] == 1;
    layout_.first = *numbers[0];
    layout_.step = *numbers[1];
    if (layout_.even && !(std::isfinite(layout_.first) && std::isfinite(layout_.step)))
      fail(7, line, "expected a finite first abscissa and step");
  }

  // I10,3I5,2(1X,20A1).
  UniversalAxis read_axis(int record, std::string_view line) const {
    const std::vector<std::string_view> words = words_of(line);
    const auto type = words.empty() ? std::optional(0) : parse_integer(words[0]);
    if (!type) fail(record, line, "expected an axis: its data type, three exponents, a label and a unit");
    UniversalAxis axis;
    axis.data_type = *type;
    if (is_blank(columns(line, 47, 47).empty() ? ' ' : line[46]) && words.size() > 4 &&
        words[4].data() >= line.data() + 25) {
      axis.label = name_of(columns(line, 27, 46));
      axis.unit = name_of(columns(line, 48, std::max<std::size_t>(line.size(), 48)));
    } else if (words.size() > 4) {
      // Shifted columns: label and unit stand apart by more than one blank.
      const std::string_view both = trimmed(line.substr(words[4].data() - line.data()));
      const auto gap = both.find("  ");
      axis.label = name_of(both.substr(0, gap));
      if (gap != std::string_view::npos) axis.unit = name_of(both.substr(gap));
    }
    return axis;
  }

  // The numbers as they come, `take(i, number)` for each.
  void place_number(std::size_t i, double value) {
    const std::size_t width = layout_.ordinates() + (layout_.even ? 0 : 1);
    const Eigen::Index row = i / width;
    std::size_t column = i % width;
    if (!layout_.even) {
      if (column == 0) {
        function_.abscissa[row] = value;
        return;
      }
      --column;
    }
    auto& ordinate = function_.values[row];
    column == 0 ? ordinate.real(value) : ordinate.imag(value);
  }

  void make_room() {
    const Eigen::Index count = layout_.count;
    function_.values = Eigen::VectorXcd::Zero(count);
    function_.abscissa.resize(count);
    if (!layout_.even) return;
    for (Eigen::Index i = 0; i < count; ++i)
      function_.abscissa[i] = layout_.first + static_cast<double>(i) * layout_.step;
  }

  void read_text() {
    // Each number takes a character at least: a count that the file cannot hold is not room to be made.
    if (layout_.numbers() > lines_.rest().size())
      fail(7, std::to_string(layout_.count), "expected a number of values that the file holds");
    make_room();
    const std::size_t wanted = layout_.numbers();
    std::size_t got = 0;
    for (;;) {
      const auto line = lines_.next();
      if (!line || is_delimiter(*line)) {
        if (got < wanted) {
          throw DataError(source_.name, value_place(), line ? "-1" : "end of the file",
                          "expected " + std::to_string(wanted) + " numbers, as record 7 says, after " +
                              std::to_string(got));
        }
        return;
      }
      std::string_view rest = *line;
      while (got < wanted) {
        while (!rest.empty() && is_blank(rest.front())) rest.remove_prefix(1);
        if (rest.empty()) break;
        const auto value = take_number(rest);
        if (!value) {
          throw DataError(source_.name, value_place(),
                          std::string(rest.substr(0, rest.find_first_of(kBlanks))), "expected a number");
        }
        place_number(got++, *value);
      }
      // What follows the last value (a filled-up line, further records) tells nothing.
    }
  }

  std::string value_place() const {
    return line_place(lines_.line()) + " (function " + std::to_string(number()) + ", record 12)";
  }

  void read_binary() {
    // Writers differ in what an uneven abscissa takes in double precision: the bytes tell.
    const std::size_t number_bytes = layout_.is_double ? 8 : 4;
    const std::size_t full = layout_.numbers() * number_bytes;
    const std::size_t with_short_abscissa =
        full - (layout_.even || !layout_.is_double ? 0 : layout_.count * 4);
    const std::string_view rest = lines_.rest();
    const auto ends_there = [&](std::size_t bytes) {
      if (bytes > rest.size()) return false;
      std::string_view after = rest.substr(bytes);
      const auto from = after.find_first_not_of(" \r\n\t");
      return from == std::string_view::npos || after.substr(from).starts_with("-1");
    };
    const bool short_abscissa = with_short_abscissa != full &&
                                header_.bytes.value_or(full) == with_short_abscissa &&
                                ends_there(with_short_abscissa);
    const std::size_t bytes = short_abscissa ? with_short_abscissa : full;
    if (bytes > rest.size()) {
      throw DataError(source_.name, value_place(), std::to_string(rest.size()) + " bytes",
                      "expected " + std::to_string(bytes) + ", as record 7 says");
    }
    // More bytes than the values take are fill, where the dataset ends behind them and not before.
    const std::size_t whole = ends_there(bytes) ? bytes : header_.bytes.value_or(bytes);
    if (!ends_there(std::max(whole, bytes))) {
      throw DataError(source_.name, value_place(), std::to_string(header_.bytes.value_or(0)) + " bytes",
                      "expected " + std::to_string(bytes) + " bytes of values, then -1");
    }
    make_room();
    const char* at = rest.data();
    const std::size_t width = layout_.ordinates() + (layout_.even ? 0 : 1);
    for (std::size_t i = 0; i < layout_.numbers(); ++i) {
      const bool is_short = !layout_.is_double || (short_abscissa && i % width == 0);
      place_number(i, binary_number(at, is_short));
      at += is_short ? 4 : 8;
    }
    lines_.skip(std::max(whole, bytes));
    while (const auto line = lines_.next()) {
      if (is_delimiter(*line)) break;
    }
  }

  double binary_number(const char* at, bool is_short) const {
    std::array<char, 8> bytes{};
    const std::size_t size = is_short ? 4 : 8;
    std::memcpy(bytes.data(), at, size);
    const bool big = header_.byte_order == 2;
    if (big != (std::endian::native == std::endian::big))
      std::reverse(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
    double value = 0;
    if (is_short) {
      float single = 0;
      std::memcpy(&single, bytes.data(), size);
      value = static_cast<double>(single);
    } else {
      std::memcpy(&value, bytes.data(), size);
    }
    return std::isfinite(value) ? value : kNotANumber;
  }

  const Source& source_;
  LineReader& lines_;
  const DatasetHeader header_;
  Layout layout_;
  UniversalFunction function_;
};

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
  while (const auto line = lines.next()) {
    if (is_delimiter(*line)) break;
  }
  return units;
}

}  // namespace

std::string UniversalFunction::place(int record) const {
  return line_place(line + record - 1) + " (function " + std::to_string(number) + ", record " +
         std::to_string(record) + ")";
}

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
      functions.push_back(
          DatasetReader(source, lines, *header, static_cast<int>(functions.size()) + 1).read(units));
    } else if (header->number == 164) {
      units = read_units(source, lines);
      // Of a file that says its units at the end.
      for (UniversalFunction& function : functions) {
        if (!function.units) function.units = units;
      }
    } else {
      ++others;
      while (const auto skipped = lines.next()) {
        if (is_delimiter(*skipped)) break;
      }
    }
  }
  if (functions.empty()) {
    throw DataError(source.name, "", std::to_string(others + (units ? 1 : 0)) + " datasets, none of them 58",
                    "expected a universal file with functions, dataset 58");
  }
  return functions;
}

}  // namespace stablecut::document
