#include "document/measured/frf_columns.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/number_text.h"
#include "base/range.h"
#include "base/units.h"
#include "document/measured/frf_column_plan.h"
#include "document/measured/tap_column_name.h"
#include "document/text/data_error.h"
#include "document/text/plain_text.h"
#include "document/text/table_text.h"

namespace stablecut::document {
namespace {

constexpr double kMostRadians = 1.001 * kPi;  // a phase without a unit is in degrees beyond
constexpr double kLongestRecord = 1e-3;       // Hz between lines: a record of 1000 s
constexpr double kMostCoherence = 1 + 1e-6;   // a 1 as programs round it

// The unit at the end of a row: its last field, or the last few together, but for the names of the parts.
std::optional<FrfUnit> unit_at_end(const TableRow& row) {
  constexpr std::size_t kMostFields = 8;
  std::string text;
  for (std::size_t count = 1; count <= std::min(kMostFields, row.fields.size()); ++count) {
    const std::string& field = row.fields[row.fields.size() - count];
    if (is_number(field)) break;
    if (part_at_end(field)) continue;
    text = field + (text.empty() ? "" : " " + text);
    if (const auto unit = frf_unit(text)) return unit;
  }
  return std::nullopt;
}

class ColumnReader {
 public:
  ColumnReader(const Source& source, const FrfChoice& choice, std::vector<Remark>& remarks)
      : source_(source), choice_(choice), remarks_(remarks), rows_(table_rows(source)) {}

  dynamics::FrequencyResponse read() {
    if (rows_.empty()) throw DataError(source_.name, "", "", "empty input: expected columns of numbers");
    const std::size_t first = first_of_numbers();
    refuse_named_time(first);
    dynamics::FrequencyResponse frf;
    plan_ = plan_columns(source_, rows_, first, choice_);
    set_quantity(frf);
    take_numbers(frf, first);
    refuse_times(frf.frequency_hz, first);
    return frf;
  }

 private:
  static constexpr const char* kNoTimes = "a time: expected frequencies, not a record over the time";

  void refuse_named_time(std::size_t first) const {
    if (first == 0) return;
    const TableRow& header = rows_[first - 1];
    if (header.fields.size() < rows_[first].fields.size()) return;
    const auto name = tap_column_name(header.fields[0]);
    if (name && name->kind == TapColumnKind::kTime)
      throw DataError(source_.name, line_place(header.line), '"' + header.fields[0] + '"', kNoTimes,
                      Remedy::kTaps);
  }

  // Without a header. No hit rings long enough for lines that near to each other.
  void refuse_times(const Eigen::VectorXd& frequency_hz, std::size_t first) const {
    const Eigen::Index last = frequency_hz.size() - 1;
    if (last < 1 || plan_.header_line > 0) return;
    const double step = (frequency_hz[last] - frequency_hz[0]) / static_cast<double>(last);
    if (step > kLongestRecord) return;
    throw DataError(source_.name, line_place(rows_[first].line),
                    "a first column in steps of " + number_text(step, 3), kNoTimes, Remedy::kTaps);
  }

  // A row of numbers: the first three fields, and all others up to empty ones at the end. The unit may follow
  // on the very first.
  bool is_numbers(std::size_t index) const {
    const TableRow& row = rows_[index];
    std::size_t numbers = 0;
    const bool at_zero = !row.fields.empty() && parse_number(row.fields[0]) == 0.0;
    while (numbers < row.fields.size() &&
           (is_number(row.fields[numbers]) || (at_zero && is_no_number(row.fields[numbers]))))
      ++numbers;
    if (numbers < 3) return false;
    if (numbers == row.fields.size()) return true;
    const bool names_parts = std::any_of(row.fields.begin(), row.fields.end(), part_at_end);
    if (index == 0 && (names_parts ? parts_at_end(row).has_value() : unit_at_end(row).has_value()))
      return true;
    return std::all_of(row.fields.begin() + static_cast<std::ptrdiff_t>(numbers), row.fields.end(),
                       [](const std::string& field) { return field.empty(); });
  }

  // The first row of numbers; what stands before it is a header, or passed over.
  std::size_t first_of_numbers() const {
    std::size_t first = 0;
    while (first < rows_.size() && !is_numbers(first)) ++first;
    for (std::size_t i = 0; i < first; ++i) {
      // A row of data with something wrong in it is refused, not passed over as a header.
      const TableRow& row = rows_[i];
      const bool begins = !row.fields.empty() && is_number(row.fields[0]) && row.fields.size() >= 3;
      if (begins && (first == rows_.size() || row.fields.size() == rows_[first].fields.size()))
        data_wrong(row);
      // Three numbers and a text: a .frf whose unit is not known.
      if (begins && is_number(row.fields[1]) && is_number(row.fields[2])) {
        std::string text;
        for (std::size_t f = 3; f < row.fields.size(); ++f) text += (f == 3 ? "" : " ") + row.fields[f];
        throw DataError(source_.name, line_place(row.line), text,
                        "expected a unit behind the numbers, as m/N, or nothing");
      }
    }
    if (first < rows_.size()) return first;
    if (rows_.size() == 1 && is_header(rows_.front()) && rows_.front().fields.size() >= 3)
      throw DataError(source_.name, line_place(rows_.front().line), "", "expected numbers below the header");
    refuse_column_count(source_, rows_.back());
  }

  [[noreturn]] void data_wrong(const TableRow& row) const {
    static constexpr std::array kWords = {"a frequency", "a real part", "an imaginary part"};
    for (std::size_t i = 0; i < row.fields.size(); ++i)
      table_number(source_, row, i, i < kWords.size() ? kWords[i] : "a number");
    refuse_column_count(source_, row);
  }

  [[noreturn]] void header_wrong(const std::string& value, const std::string& expected,
                                 Remedy remedy = Remedy::kNone) const {
    throw DataError(source_.name, line_place(plan_.header_line), value, expected, remedy);
  }

  // One quantity for all entries; each entry's numbers times its own factor.
  void set_quantity(dynamics::FrequencyResponse& frf) {
    std::optional<FrfUnit> common = choice_.unit;
    // At the end of the first line, be it a header or numbers.
    const std::optional<FrfUnit> at_end = unit_at_end(rows_.front());
    if (!common) common = at_end;
    if (choice_.form == FrfForm::kCutPro && !common) {
      throw DataError(source_.name, line_place(rows_.front().line), "",
                      "expected a unit at the end of the first line of a .frf, as m/N");
    }
    frf.quantity = choice_.quantity.value_or(dynamics::Quantity::kReceptance);
    bool told = false;
    const auto with_unit = std::count_if(plan_.entries.begin(), plan_.entries.end(),
                                         [](const EntryColumns& entry) { return entry.unit.has_value(); });
    if (!common && with_unit > 0 && with_unit < static_cast<std::ptrdiff_t>(plan_.entries.size()))
      header_wrong("units", "expected them for all entries, or for none", Remedy::kUnit);
    for (EntryColumns& entry : plan_.entries) {
      if (choice_.unit || (common && !entry.unit)) entry.unit = common;
      if (!entry.unit) continue;
      if (told && entry.unit->quantity != frf.quantity)
        header_wrong(entry.response + entry.reference, "expected the quantity of the columns before");
      if (!told && choice_.quantity && entry.unit->quantity != *choice_.quantity)
        remarks_.push_back({RemarkKind::kUnitOverruled, source_.name, {plan_.header_line}, "", "", {}});
      told = true;
      if (!choice_.quantity) frf.quantity = entry.unit->quantity;
    }
  }

  // A number; at 0 Hz, where nothing is learnt, whatever a program made of dividing by zero is 0.
  double part_of(const TableRow& row, std::size_t column, const char* words, bool at_zero) const {
    if (at_zero && column < row.fields.size() &&
        (row.fields[column].empty() || is_no_number(row.fields[column])))
      return 0;
    return table_number(source_, row, column, words);
  }

  void take_numbers(dynamics::FrequencyResponse& frf, std::size_t first) {
    const Eigen::Index lines = rows_.size() - first;
    frf.frequency_hz.resize(lines);
    for (const EntryColumns& columns : plan_.entries) {
      dynamics::FrequencyResponseEntry entry;
      entry.response = columns.response;
      entry.reference = columns.reference;
      entry.h.resize(lines);
      if (columns.coherence != kNoColumn) {
        entry.coherence.resize(lines);
        entry.averages = choice_.averages;
      }
      frf.entries.push_back(std::move(entry));
    }
    const std::size_t width = number_of_columns(rows_[first]);
    for (Eigen::Index line = 0; line < lines; ++line) {
      const TableRow& row = rows_[first + static_cast<std::size_t>(line)];
      check_width(row, width, line == 0);
      const double frequency = plan_.to_hz * table_number(source_, row, plan_.frequency, "a frequency");
      if (frequency < 0 || !std::isfinite(frequency) ||
          (line > 0 && !(frequency > frf.frequency_hz[line - 1]))) {
        throw DataError(source_.name, line_place(row.line), row.fields[plan_.frequency],
                        "expected increasing frequencies, none below 0 Hz");
      }
      for (const std::size_t column : plan_.more_frequencies) {
        if (table_number(source_, row, column, "a frequency") * plan_.to_hz == frequency) continue;
        throw DataError(source_.name, line_place(row.line), row.fields[column],
                        "expected the frequency of column " + std::to_string(plan_.frequency + 1));
      }
      frf.frequency_hz[line] = frequency;
      for (std::size_t e = 0; e < plan_.entries.size(); ++e)
        take_entry(frf.entries[e], plan_.entries[e], row, line, frequency == 0);
    }
    for (std::size_t e = 0; e < plan_.entries.size(); ++e)
      finish_entry(frf.entries[e], plan_.entries[e], first);
  }

  void check_width(const TableRow& row, std::size_t width, bool first) const {
    std::size_t fields = row.fields.size();
    while (fields > width && (row.fields[fields - 1].empty() || first)) --fields;
    if (fields == width) return;
    throw DataError(source_.name, line_place(row.line), std::to_string(fields) + " columns",
                    "expected " + std::to_string(width) + " as in the lines before");
  }

  void take_entry(dynamics::FrequencyResponseEntry& entry, const EntryColumns& columns, const TableRow& row,
                  Eigen::Index line, bool at_zero) const {
    entry.h[line] = {
        part_of(row, columns.parts[0], columns.polar ? "a magnitude" : "a real part", at_zero),
        part_of(row, columns.parts[1], columns.polar ? "a phase" : "an imaginary part", at_zero)};
    if (columns.coherence == kNoColumn) return;
    const double coherence = part_of(row, columns.coherence, "a coherence", at_zero);
    if (!(coherence >= 0 && coherence <= kMostCoherence)) {
      throw DataError(source_.name, line_place(row.line), row.fields[columns.coherence],
                      "expected a coherence from 0 to 1");
    }
    entry.coherence[line] = std::min(coherence, 1.0);
  }

  // Magnitude and phase to a complex number, and to SI.
  void finish_entry(dynamics::FrequencyResponseEntry& entry, const EntryColumns& columns, std::size_t first) {
    if (columns.polar) {
      const double largest = entry.h.imag().cwiseAbs().maxCoeff();
      const bool radians = columns.radians.value_or(largest <= kMostRadians);
      if (!columns.radians) {
        remarks_.push_back({radians ? RemarkKind::kPhaseTakenAsRadians : RemarkKind::kPhaseTakenAsDegrees,
                            source_.name,
                            {},
                            "",
                            entry.response + entry.reference,
                            {largest}});
      }
      for (auto& value : entry.h) {
        if (!columns.decibel && value.real() < 0) {
          throw DataError(source_.name, "",
                          entry.response + entry.reference + ": magnitude " + number_text(value.real()),
                          "expected none below 0 (is it in dB?)");
        }
        const double magnitude = columns.decibel ? std::pow(10, value.real() / 20) : value.real();
        const double phase = radians ? value.imag() : radians_from_degrees(value.imag());
        value = {magnitude * std::cos(phase), magnitude * std::sin(phase)};
      }
    }
    entry.h *= columns.sign * (columns.unit ? columns.unit->to_si : 1.0);
    for (Eigen::Index i = 0; i < entry.h.size(); ++i) {
      if (std::isfinite(entry.h[i].real()) && std::isfinite(entry.h[i].imag())) continue;
      const TableRow& row = rows_[first + static_cast<std::size_t>(i)];
      throw DataError(source_.name, line_place(row.line), row.fields[columns.parts[0]],
                      "expected a number that a double can hold");
    }
  }

  const Source& source_;
  const FrfChoice& choice_;
  std::vector<Remark>& remarks_;
  std::vector<TableRow> rows_;
  ColumnPlan plan_;
};

}  // namespace

dynamics::FrequencyResponse frf_from_columns(const Source& source, const FrfChoice& choice,
                                             std::vector<Remark>& remarks) {
  return ColumnReader(source, choice, remarks).read();
}

}  // namespace stablecut::document
