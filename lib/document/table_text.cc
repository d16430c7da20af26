#include "document/table_text.h"

#include <algorithm>
#include <optional>

#include "base/range.h"
#include "document/error.h"

namespace stablecut {
namespace {

constexpr const char* kBlanks = " \t\r\v\f";

std::string_view trimmed(std::string_view text) {
  const auto from = text.find_first_not_of(kBlanks);
  if (from == std::string_view::npos) return {};
  return text.substr(from, text.find_last_not_of(kBlanks) - from + 1);
}

std::string_view unquoted(std::string_view field) {
  field = trimmed(field);
  if (field.size() >= 2 && field.front() == '"' && field.back() == '"')
    field = field.substr(1, field.size() - 2);
  return field;
}

std::vector<std::string> split(std::string_view line, char separator) {
  std::vector<std::string> fields;
  if (separator == ' ') {
    while (!(line = trimmed(line)).empty()) {
      const auto end = line.find_first_of(kBlanks);
      fields.emplace_back(unquoted(line.substr(0, end)));
      if (end == std::string_view::npos) break;
      line.remove_prefix(end);
    }
    return fields;
  }
  for (;;) {
    const auto end = line.find(separator);
    fields.emplace_back(unquoted(line.substr(0, end)));
    if (end == std::string_view::npos) return fields;
    line.remove_prefix(end + 1);
  }
}

}  // namespace

std::vector<TableRow> table_rows(const Source& source) {
  std::string_view rest = source.text;
  if (rest.starts_with("\xEF\xBB\xBF")) rest.remove_prefix(3);
  std::vector<TableRow> rows;
  char separator = 0;
  for (long number = 1; !rest.empty(); ++number) {
    const auto end = rest.find('\n');
    const std::string_view line = trimmed(rest.substr(0, end));
    rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
    if (line.empty() || line.front() == '#' || line.front() == '%') continue;
    if (separator == 0) {
      separator = ' ';
      for (const char candidate : {',', ';', '\t'}) {
        if (line.find(candidate) != std::string_view::npos) separator = candidate;
      }
    }
    rows.push_back({number, split(line, separator)});
    if (separator == ';' || separator == '\t') {
      for (std::string& field : rows.back().fields) {
        std::string pointed = field;
        std::replace(pointed.begin(), pointed.end(), ',', '.');
        if (parse_number(pointed)) field = pointed;
      }
    }
  }
  return rows;
}

bool is_header(const TableRow& row) {
  return std::none_of(row.fields.begin(), row.fields.end(),
                      [](const std::string& field) { return parse_number(field).has_value(); });
}

double table_number(const Source& source, const TableRow& row, std::size_t column, const char* expected) {
  const std::string wanted = std::string("expected ") + expected + " in column " + std::to_string(column + 1);
  if (column >= row.fields.size()) {
    throw DataError(source.name, line_place(row.line), std::to_string(row.fields.size()) + " columns",
                    wanted);
  }
  const auto value = parse_number(row.fields[column]);
  if (!value) throw DataError(source.name, line_place(row.line), '"' + row.fields[column] + '"', wanted);
  return *value;
}

}  // namespace stablecut
