#include "document/measured/universal_records.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/range.h"
#include "document/measured/fortran_number.h"
#include "document/text/data_error.h"
#include "document/text/plain_text.h"

namespace stablecut::document {
namespace {

// A number that fills the whole field.
std::optional<double> whole_number(std::string_view field) {
  const auto value = take_number(field);
  return field.empty() ? value : std::nullopt;
}

template <typename List>
bool all_known(const List& values) {
  return std::all_of(values.begin(), values.end(), [](const auto& value) { return value.has_value(); });
}

class RecordReader {
 public:
  RecordReader(const Source& source, UniversalFunction& function) : source_(source), function_(function) {}

  void read(int record, std::string_view line) {
    if (record <= 5) {
      function_.id[record - 1] = field_name(line);
    } else if (record == 6) {
      read_dofs(line);
    } else if (record == 7) {
      read_layout(line);
    } else if (record <= 10) {
      UniversalAxis& axis = record == 8   ? function_.abscissa_axis
                            : record == 9 ? function_.ordinate
                                          : function_.denominator;
      axis = read_axis(record, line);
    }
  }

  const ValueLayout& layout() const { return layout_; }

 private:
  [[noreturn]] void fail(int record, std::string_view value, const std::string& expected) const {
    throw DataError(source_.name, function_.place(record).text(), std::string(trimmed(value)), expected);
  }

  // 2(I5,I10),2(1X,10A1,I10,I4). Writers shift the columns; ten words are unambiguous.
  void read_dofs(std::string_view line) {
    const std::vector<LineWord> words = words_of(line);
    std::array<std::optional<int>, 8> numbers;
    std::array<std::string_view, 2> names;
    if (words.size() == 10) {
      for (std::size_t i = 0; i < 4; ++i) numbers[i] = parse_integer(words[i].text);
      for (std::size_t side = 0; side < 2; ++side) {
        names[side] = words[4 + 3 * side].text;
        for (std::size_t i = 0; i < 2; ++i)
          numbers[4 + 2 * side + i] = parse_integer(words[5 + 3 * side + i].text);
      }
    }
    if (!all_known(numbers)) {
      names = {columns_of(line, 32, 41), columns_of(line, 57, 66)};
      constexpr std::array<std::array<std::size_t, 2>, 8> kFields = {
          {{1, 5}, {6, 15}, {16, 20}, {21, 30}, {42, 51}, {52, 55}, {67, 76}, {77, 80}}};
      for (std::size_t i = 0; i < numbers.size(); ++i)
        numbers[i] = field_integer(columns_of(line, kFields[i][0], kFields[i][1]));
    }
    if (!all_known(numbers))
      fail(6, line, "expected a function type, and a name, a node and a direction of response and reference");
    function_.type = *numbers[0];
    function_.response = {field_name(names[0]), *numbers[4], *numbers[5]};
    function_.reference = {field_name(names[1]), *numbers[6], *numbers[7]};
  }

  // 3I10,3E13.5, by words or, where these do not tell, by columns.
  void read_layout(std::string_view line) {
    const std::vector<LineWord> words = words_of(line);
    std::array<std::optional<int>, 3> integers;
    std::array<std::optional<double>, 2> numbers;
    if (words.size() >= 5) {
      for (std::size_t i = 0; i < 3; ++i) integers[i] = parse_integer(words[i].text);
      for (std::size_t i = 0; i < 2; ++i) numbers[i] = whole_number(words[3 + i].text);
    }
    if (!all_known(integers) || !all_known(numbers)) {
      for (std::size_t i = 0; i < 3; ++i)
        integers[i] = field_integer(columns_of(line, 1 + 10 * i, 10 + 10 * i));
      for (std::size_t i = 0; i < 2; ++i) {
        const std::string_view field = trimmed(columns_of(line, 31 + 13 * i, 43 + 13 * i));
        numbers[i] = field.empty() ? std::optional(0.0) : whole_number(field);
      }
    }
    if (!all_known(integers) || !all_known(numbers))
      fail(7, line,
           "expected the data type, the number of values, the spacing, the first abscissa and its step");
    set_layout(*integers[0], *integers[1], *integers[2]);
    layout_.first = *numbers[0];
    layout_.step = *numbers[1];
    if (layout_.even && !(std::isfinite(layout_.first) && std::isfinite(layout_.step)))
      fail(7, line, "expected a finite first abscissa and step");
  }

  void set_layout(int type, int count, int spacing) {
    if (type != 2 && type != 4 && type != 5 && type != 6)
      fail(7, std::to_string(type), "expected an ordinate data type 2, 4 (real), 5 or 6 (complex)");
    if (count < 1) fail(7, std::to_string(count), "expected a number of values above 0");
    if (spacing != 0 && spacing != 1)
      fail(7, std::to_string(spacing), "expected an abscissa spacing 0 (uneven) or 1 (even)");
    layout_.count = static_cast<std::size_t>(count);
    layout_.is_complex = function_.is_complex = type >= 5;
    layout_.is_double = type == 4 || type == 6;
    layout_.even = spacing == 1;
  }

  // I10,3I5,2(1X,20A1).
  UniversalAxis read_axis(int record, std::string_view line) const {
    const std::vector<LineWord> words = words_of(line);
    const auto type = words.empty() ? std::optional(0) : parse_integer(words[0].text);
    if (!type) fail(record, line, "expected an axis: its data type, three exponents, a label and a unit");
    UniversalAxis axis;
    axis.data_type = *type;
    if (words.size() <= 4) return axis;
    const bool gap_between = line.size() < 47 || is_blank(line[46]);
    if (gap_between && words[4].at >= 25) {
      axis.label = field_name(columns_of(line, 27, 46));
      axis.unit = field_name(columns_of(line, 48, std::max<std::size_t>(line.size(), 48)));
      return axis;
    }
    // Shifted columns: label and unit stand apart by more than one blank.
    const std::string_view both = trimmed(line.substr(words[4].at));
    const auto gap = both.find("  ");
    axis.label = field_name(both.substr(0, gap));
    if (gap != std::string_view::npos) axis.unit = field_name(both.substr(gap));
    return axis;
  }

  const Source& source_;
  UniversalFunction& function_;
  ValueLayout layout_;
};

}  // namespace

std::optional<DatasetHeader> dataset_header(std::string_view line) {
  std::vector<LineWord> words = words_of(line);
  if (words.empty()) return std::nullopt;
  DatasetHeader header;
  std::string_view first = words[0].text;
  header.binary = first.ends_with('b') || first.ends_with('B');
  if (header.binary) first.remove_suffix(1);
  const auto number = parse_integer(first);
  if (!number || *number < 1) return std::nullopt;
  header.number = *number;
  if (!header.binary) return header;
  const auto word = [&](std::size_t i) {
    return i < words.size() ? parse_integer(words[i].text) : std::nullopt;
  };
  header.byte_order = word(1).value_or(1);
  header.float_format = word(2).value_or(2);
  header.header_lines = word(3).value_or(kUniversalHeaderRecords);
  if (const auto bytes = word(4); bytes && *bytes > 0) header.bytes = static_cast<std::size_t>(*bytes);
  return header;
}

ValueLayout read_records(const Source& source, LineReader& lines, const DatasetHeader& header,
                         UniversalFunction& function) {
  RecordReader reader(source, function);
  const int count =
      header.binary ? std::max(kUniversalHeaderRecords, header.header_lines) : kUniversalHeaderRecords;
  for (int record = 1; record <= count; ++record) {
    const auto line = lines.next();
    // Records 1 to 5 are free text, which may be a -1.
    if (!line || (record > 5 && is_delimiter(*line))) {
      throw DataError(source.name, function.place(record).text(), line ? "-1" : "end of the file",
                      "expected record " + std::to_string(record) + " of dataset 58");
    }
    reader.read(record, *line);
  }
  return reader.layout();
}

}  // namespace stablecut::document
