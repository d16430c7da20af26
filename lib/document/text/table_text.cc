#include "document/text/table_text.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "base/range.h"
#include "document/text/data_error.h"
#include "document/text/plain_text.h"

namespace stablecut::document {
namespace {

std::string_view unquoted(std::string_view field) {
  field = trimmed(field);
  if (field.size() >= 2 && field.front() == '"' && field.back() == '"')
    field = field.substr(1, field.size() - 2);
  return field;
}

std::vector<std::string> fields_of(std::string_view line, char separator) {
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
    // A separator inside quotes belongs to the field.
    std::size_t end = 0;
    const auto start = line.find_first_not_of(kBlanks);
    if (start != std::string_view::npos && line[start] == '"') {
      const auto quote = line.find('"', start + 1);
      if (quote != std::string_view::npos) end = quote;
    }
    end = line.find(separator, end);
    fields.emplace_back(unquoted(line.substr(0, end)));
    if (end == std::string_view::npos) return fields;
    line.remove_prefix(end + 1);
  }
}

struct Line {
  long number;            // 1-based
  std::string_view text;  // without blanks at its ends
  long tabs;              // before the text
};

long leading_tabs(std::string_view line) {
  const auto first = std::min(line.find_first_not_of(kBlanks), line.size());
  return std::count(line.begin(), line.begin() + first, '\t');
}

bool is_comment(std::string_view line) {
  return line.front() == '#' || line.front() == '%' || line.front() == '!' || line.starts_with("//");
}

// The separator of a line: the first of tab, semicolon, bar, comma that it holds, else blanks. Commas inside
// numbers that blanks separate are decimal commas.
char separator_of(std::string_view line) {
  for (const char candidate : {'\t', ';', '|'}) {
    if (line.find(candidate) != std::string_view::npos) return candidate;
  }
  if (line.find(',') == std::string_view::npos) return ' ';
  const std::vector<std::string> fields = fields_of(line, ' ');
  const bool decimal_commas =
      fields.size() > 1 && std::all_of(fields.begin(), fields.end(), [](std::string field) {
        std::replace(field.begin(), field.end(), ',', '.');
        return parse_number(field).has_value();
      });
  return decimal_commas ? ' ' : ',';
}

// Minus signs that word processors put for hyphens.
std::string plain_minus(std::string field) {
  for (auto at = field.find("\xE2\x88\x92"); at != std::string::npos; at = field.find("\xE2\x88\x92", at)) {
    field.replace(at, 3, "-");
  }
  return field;
}

}  // namespace

std::vector<TableRow> table_rows(const Source& source) {
  std::string_view rest = source.text;
  if (rest.starts_with("\xEF\xBB\xBF")) rest.remove_prefix(3);
  if (is_utf16(rest)) throw DataError(source.name, "", "UTF-16 text", "expected UTF-8");
  const char line_end = rest.find('\n') == std::string_view::npos ? '\r' : '\n';  // old Macintosh files
  std::vector<Line> lines;
  for (long number = 1; !rest.empty(); ++number) {
    const auto end = rest.find(line_end);
    const std::string_view whole = rest.substr(0, end), line = trimmed(whole);
    rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
    if (!line.empty() && !is_comment(line)) lines.push_back({number, line, leading_tabs(whole)});
  }
  if (lines.empty()) return {};
  // The last line is the least likely to be a header or a remark.
  char separator = separator_of(lines.back().text);
  if (lines.front().text.size() == 5 && lines.front().text.starts_with("sep=")) {  // a spreadsheet's own note
    separator = lines.front().text.back();
    lines.erase(lines.begin());
  }
  // Tabs before the first field of every line indent them; more are empty cells.
  const auto by_tabs = [](const Line& a, const Line& b) { return a.tabs < b.tabs; };
  const long indent = lines.empty() ? 0 : std::min_element(lines.begin(), lines.end(), by_tabs)->tabs;
  std::vector<TableRow> rows;
  bool has_point = false, has_comma = false;
  for (const Line& line : lines) {
    std::vector<std::string> fields(separator == '\t' ? line.tabs - indent : 0);
    for (std::string& field : fields_of(line.text, separator)) fields.push_back(std::move(field));
    rows.push_back({line.number, std::move(fields)});
    for (std::string& field : rows.back().fields) {
      field = plain_minus(std::move(field));
      // A comma left inside a field is a decimal comma where the whole field is then a number.
      const bool comma = field.find(',') != std::string::npos;
      std::string pointed = field;
      if (comma) std::replace(pointed.begin(), pointed.end(), ',', '.');
      if (!parse_number(pointed)) continue;
      (comma ? has_comma : has_point) |= pointed.find('.') != std::string::npos;
      if (has_comma && has_point) {
        throw DataError(
            source.name, line_place(line.number), field,
            "expected one decimal mark in the file, commas or points, and no thousands separators");
      }
      field = std::move(pointed);
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

}  // namespace stablecut::document
