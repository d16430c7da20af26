#include "document/frf_csv.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <optional>
#include <vector>

#include "document/error.h"
#include "document/table_text.h"

namespace stablecut {
namespace {

struct EntryColumns {
  std::string response, reference;
  std::size_t re = 0, im = 0;
};

struct ColumnName {
  std::string directions;  // "xy"
  bool imaginary = false;
};

// `Hxy (imag)` -> xy, imaginary. Nothing when the name does not tell both.
std::optional<ColumnName> column_name(const std::string& field) {
  std::vector<std::string> words(1);
  for (const char c : field) {
    if (std::isalnum(static_cast<unsigned char>(c))) {
      words.back() += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    } else if (!words.back().empty()) {
      words.emplace_back();
    }
  }
  ColumnName name;
  bool has_part = false;
  const auto is_direction = [](char c) { return c == 'x' || c == 'y' || c == 'z'; };
  for (std::string word : words) {
    if (word == "re" || word == "real" || word == "im" || word == "imag" || word == "imaginary") {
      has_part = true;
      name.imaginary = word[0] == 'i';
      continue;
    }
    if (word.size() == 3 && (word[0] == 'h' || word[0] == 'g')) word.erase(0, 1);
    if (word.size() == 2 && is_direction(word[0]) && is_direction(word[1])) name.directions = word;
  }
  if (!has_part || name.directions.empty()) return std::nullopt;
  return name;
}

std::vector<EntryColumns> named_columns(const Source& source, const TableRow& header) {
  std::map<std::string, EntryColumns> found;
  for (std::size_t i = 1; i < header.fields.size(); ++i) {
    const auto name = column_name(header.fields[i]);
    if (!name) continue;
    EntryColumns& columns = found[name->directions];
    columns.response = name->directions.substr(0, 1);
    columns.reference = name->directions.substr(1, 1);
    (name->imaginary ? columns.im : columns.re) = i;
  }
  std::vector<EntryColumns> result;
  for (const auto& [directions, columns] : found) {
    if (columns.re == 0 || columns.im == 0) {
      throw DataError(source.name, line_place(header.line), directions,
                      "expected a column of the real and one of the imaginary part");
    }
    result.push_back(columns);
  }
  return result;
}

std::vector<EntryColumns> columns_by_count(const Source& source, const TableRow& row) {
  if (row.fields.size() == 3) return {{"x", "x", 1, 2}};
  if (row.fields.size() == 9) {
    return {{"x", "x", 1, 2}, {"x", "y", 3, 4}, {"y", "x", 5, 6}, {"y", "y", 7, 8}};
  }
  throw DataError(
      source.name, line_place(row.line), std::to_string(row.fields.size()) + " columns",
      "expected 3 columns (Hz, real, imaginary), 9 (xx, xy, yx, yy), or a header that names them");
}

}  // namespace

FrequencyResponse frf_from_csv(const Source& source, Quantity quantity) {
  std::vector<TableRow> rows = table_rows(source);
  if (rows.empty()) throw DataError(source.name, "", "", "empty input: expected columns of numbers");
  std::vector<EntryColumns> columns;
  if (is_header(rows.front())) {
    columns = named_columns(source, rows.front());
    const long header_line = rows.front().line;
    rows.erase(rows.begin());
    if (rows.empty())
      throw DataError(source.name, line_place(header_line), "", "expected numbers below the header");
  }
  if (columns.empty()) columns = columns_by_count(source, rows.front());

  FrequencyResponse frf;
  frf.quantity = quantity;
  const auto lines = static_cast<Eigen::Index>(rows.size());
  frf.frequency_hz.resize(lines);
  for (const EntryColumns& column : columns) {
    FrequencyResponseEntry entry;
    entry.response = column.response;
    entry.reference = column.reference;
    entry.h.resize(lines);
    frf.entries.push_back(std::move(entry));
  }
  const std::size_t width = rows.front().fields.size();
  for (Eigen::Index line = 0; line < lines; ++line) {
    const TableRow& row = rows[static_cast<std::size_t>(line)];
    if (row.fields.size() != width) {
      throw DataError(source.name, line_place(row.line), std::to_string(row.fields.size()) + " columns",
                      "expected " + std::to_string(width) + " as in the lines before");
    }
    const double frequency = table_number(source, row, 0, "a frequency in Hz");
    if (frequency < 0 || (line > 0 && !(frequency > frf.frequency_hz[line - 1]))) {
      throw DataError(source.name, line_place(row.line), row.fields[0],
                      "expected increasing frequencies, none below 0 Hz");
    }
    frf.frequency_hz[line] = frequency;
    for (std::size_t e = 0; e < columns.size(); ++e) {
      frf.entries[e].h[line] = {table_number(source, row, columns[e].re, "a real part"),
                                table_number(source, row, columns[e].im, "an imaginary part")};
    }
  }
  return frf;
}

}  // namespace stablecut
