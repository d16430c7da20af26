#include "document/measured/frf_column_plan.h"

#include <algorithm>
#include <utility>

#include "base/range.h"
#include "document/measured/frf_column_name.h"
#include "document/text/data_error.h"
#include "document/text/plain_text.h"

namespace stablecut::document {
namespace {

using Names = std::vector<std::optional<ColumnName>>;

// The plan that a header's names make.
class HeaderReader {
 public:
  HeaderReader(const Source& source, const TableRow& header, const FrfChoice& choice)
      : source_(source), header_(header), choice_(choice) {
    plan_.header_line = header.line;
  }

  ColumnPlan read(const Names& names, std::size_t width) {
    if (names.size() < width) {
      fail(std::to_string(names.size()) + " names",
           "expected one for each of " + std::to_string(width) + " columns");
    }
    for (std::size_t i = 0; i < width; ++i) {
      if (!names[i]) continue;
      if (names[i]->part == ColumnPart::kFrequency)
        take_frequency(i, names[i]->unit);
      else
        take_part(i, *names[i]);
    }
    check_entries();
    return std::move(plan_);
  }

 private:
  [[noreturn]] void fail(const std::string& value, const std::string& expected,
                         Remedy remedy = Remedy::kNone) const {
    throw DataError(source_.name, line_place(plan_.header_line), value, expected, remedy);
  }

  void take_frequency(std::size_t column, const std::string& unit) {
    if (has_frequency_) {
      plan_.more_frequencies.push_back(column);
      return;
    }
    has_frequency_ = true;
    plan_.frequency = column;
    if (const auto to_hz = frequency_unit(unit)) {
      plan_.to_hz = *to_hz;
    } else if (!unit.empty()) {
      fail(unit, "expected a frequency in Hz, kHz, rad/s or rpm");
    }
  }

  void take_part(std::size_t column, const ColumnName& name) {
    EntryColumns& entry = entry_of(name);
    entry.sign = name.sign;
    if (name.part == ColumnPart::kCoherence) {
      entry.coherence = column;
      return;
    }
    const bool polar = name.part != ColumnPart::kReal && name.part != ColumnPart::kImaginary;
    const bool second = name.part == ColumnPart::kImaginary || name.part == ColumnPart::kPhase;
    if (has_part(entry) && polar != entry.polar) {
      // An entry in both forms: its real and imaginary parts are enough.
      if (polar) return;
      entry.parts = {kNoColumn, kNoColumn};
    }
    if (const std::size_t before = entry.parts[second ? 1 : 0]; before != kNoColumn) {
      fail('"' + header_.fields[before] + "\", \"" + header_.fields[column] + '"',
           "both are " + entry.response + entry.reference +
               ": expected names with the directions of response and force, as xx_re and yy_re");
    }
    entry.parts[second ? 1 : 0] = column;
    entry.polar = polar;
    // A unit row may say dB too.
    if (!second) {
      entry.decibel = name.part == ColumnPart::kDecibel || (polar && lower(name.unit).starts_with("db"));
    }
    if (name.part == ColumnPart::kPhase)
      take_phase_unit(entry, name.unit);
    else
      take_unit(entry, name.unit);
  }

  EntryColumns& entry_of(const ColumnName& name) {
    EntryColumns wanted;
    if (!name.response.empty()) wanted.response = name.response;
    if (!name.reference.empty()) wanted.reference = name.reference;
    for (EntryColumns& entry : plan_.entries) {
      if (entry.response == wanted.response && entry.reference == wanted.reference) return entry;
    }
    plan_.entries.push_back(wanted);
    return plan_.entries.back();
  }

  static bool has_part(const EntryColumns& entry) {
    return entry.parts[0] != kNoColumn || entry.parts[1] != kNoColumn;
  }

  void take_phase_unit(EntryColumns& entry, const std::string& written) const {
    const std::string unit = lower(written);
    if (unit.starts_with("rad")) entry.radians = true;
    if (unit.starts_with("deg") || unit == "\xC2\xB0" || unit == "\xB0") entry.radians = false;
    if (!unit.empty() && !entry.radians) fail(written, "expected a phase in deg or rad");
  }

  void take_unit(EntryColumns& entry, const std::string& written) const {
    const std::string unit = lower(written);
    if (const auto told = frf_unit(written)) {
      if (entry.unit && (entry.unit->to_si != told->to_si || entry.unit->quantity != told->quantity))
        fail(written, "expected one unit for both parts of " + entry.response + entry.reference);
      entry.unit = told;
    } else if (!unit.empty() && unit != "db" && unit != "-" && !choice_.unit) {
      fail(written, "expected a displacement, velocity or acceleration over a force, as m/N", Remedy::kUnit);
    }
  }

  void check_entries() {
    // A coherence alone is no entry.
    std::erase_if(plan_.entries, [](const EntryColumns& entry) { return !has_part(entry); });
    for (const EntryColumns& entry : plan_.entries) {
      if (entry.parts[0] != kNoColumn && entry.parts[1] != kNoColumn) continue;
      fail(entry.response + entry.reference,
           entry.polar ? "expected a column of the magnitude and one of the phase"
                       : "expected a column of the real and one of the imaginary part");
    }
    // A first column without a name is the frequency; one that is taken for something else is not.
    if (has_frequency_) return;
    for (const EntryColumns& entry : plan_.entries) {
      if (entry.parts[0] == 0 || entry.parts[1] == 0 || entry.coherence == 0)
        fail("first column", "expected a column of frequencies");
    }
  }

  const Source& source_;
  const TableRow& header_;
  const FrfChoice& choice_;
  ColumnPlan plan_;
  bool has_frequency_ = false;
};

// The row before the numbers that has most names of columns, and its names; a row of units may follow it.
// None: the first row of numbers, and no names.
std::pair<std::size_t, Names> find_names(const std::vector<TableRow>& rows, std::size_t first) {
  std::pair<std::size_t, Names> best{first, {}};
  std::ptrdiff_t most = 0;
  for (std::size_t i = first; i > 0; --i) {
    Names names;
    for (const std::string& field : rows[i - 1].fields) names.push_back(column_name(field));
    const auto known =
        std::count_if(names.begin(), names.end(), [](const auto& name) { return name.has_value(); });
    const bool beyond_frequency = std::any_of(names.begin(), names.end(), [](const auto& name) {
      return name && name->part != ColumnPart::kFrequency;
    });
    if (known <= most || !beyond_frequency || names.size() < 3) continue;
    most = known;
    best = {i - 1, std::move(names)};
  }
  return best;
}

// A header of as many names as there are columns, none of which tells a part: what the columns hold would be
// a guess.
void refuse_unknown_names(const Source& source, const TableRow& row, const TableRow& numbers) {
  if (row.fields.size() < 3 || row.fields.size() > numbers.fields.size() || !is_header(row)) return;
  std::string list;
  for (const std::string& field : row.fields) list += (list.empty() ? "" : ", ") + field;
  throw DataError(
      source.name, line_place(row.line), list,
      "expected names that tell what the columns hold, as f_hz, re, im or f_hz, magnitude, phase");
}

// Adds the entries that so many columns of numbers are.
void entries_by_count(const Source& source, const TableRow& row, ColumnPlan& plan) {
  std::size_t count = 0;
  while (count < row.fields.size() && (is_number(row.fields[count]) || is_no_number(row.fields[count])))
    ++count;
  if (count != 3 && count != 9) refuse_column_count(source, row);
  for (std::size_t column = 1; column < count; column += 2) {
    EntryColumns entry;
    if (count == 9) {  // xx, xy, yx, yy
      entry.response = column < 5 ? "x" : "y";
      entry.reference = column % 4 == 1 ? "x" : "y";
    }
    entry.parts = {column, column + 1};
    if (count == 3 && parts_at_end(row) == true) std::swap(entry.parts[0], entry.parts[1]);
    plan.entries.push_back(entry);
  }
}

}  // namespace

bool is_number(const std::string& field) { return parse_number(field).has_value(); }

bool is_no_number(const std::string& field) {
  const std::string text = lower(field);
  return text.find("nan") != std::string::npos || text.find("inf") != std::string::npos ||
         text.starts_with("#");
}

std::size_t number_of_columns(const TableRow& row) {
  std::size_t width = row.fields.size();
  while (width > 0 && !is_number(row.fields[width - 1]) && !is_no_number(row.fields[width - 1])) --width;
  return width;
}

bool part_at_end(const std::string& field) {
  const auto name = column_name(field);
  return name && name->unit.empty() && name->response.empty() && name->reference.empty() &&
         (name->part == ColumnPart::kReal || name->part == ColumnPart::kImaginary);
}

std::optional<bool> parts_at_end(const TableRow& row) {
  std::vector<ColumnPart> parts;
  for (std::size_t i = number_of_columns(row); i < row.fields.size(); ++i) {
    if (part_at_end(row.fields[i])) parts.push_back(column_name(row.fields[i])->part);
  }
  if (parts.size() != 2 || parts[0] == parts[1]) return std::nullopt;
  return parts[0] == ColumnPart::kImaginary;
}

void refuse_column_count(const Source& source, const TableRow& row) {
  throw DataError(
      source.name, line_place(row.line), std::to_string(row.fields.size()) + " columns",
      "expected 3 columns (Hz, real, imaginary), 9 (xx, xy, yx, yy), or a header that names them, as "
      "f_hz,xx_re,xx_im,yy_re,yy_im");
}

ColumnPlan plan_columns(const Source& source, const std::vector<TableRow>& rows, std::size_t first,
                        const FrfChoice& choice) {
  auto [names_row, names] = find_names(rows, first);
  ColumnPlan plan;
  if (names.empty()) {
    if (first > 0) refuse_unknown_names(source, rows[first - 1], rows[first]);
    entries_by_count(source, rows[first], plan);
    return plan;
  }
  // Units below the names.
  for (std::size_t i = names_row + 1; i < first; ++i) {
    const std::vector<std::string>& units = rows[i].fields;
    for (std::size_t c = 0; c < std::min(units.size(), names.size()); ++c) {
      if (names[c] && names[c]->unit.empty()) names[c]->unit = units[c];
    }
  }
  plan = HeaderReader(source, rows[names_row], choice).read(names, number_of_columns(rows[first]));
  // The names may tell the frequency alone.
  if (plan.entries.empty()) entries_by_count(source, rows[first], plan);
  return plan;
}

}  // namespace stablecut::document
