// Which column of a table of frequency responses holds what.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "document/measured/frf_choice.h"
#include "document/text/table_text.h"

namespace stablecut::document {

inline constexpr std::size_t kNoColumn = -1;

/// Where the numbers of one entry stand.
struct EntryColumns {
  std::string response = "x", reference = "x";
  double sign = 1;
  std::array<std::size_t, 2> parts = {kNoColumn, kNoColumn};  ///< real, imaginary; or magnitude, phase
  std::size_t coherence = kNoColumn;
  bool polar = false, decibel = false;
  std::optional<bool> radians;  ///< of the phase; empty: not told
  std::optional<FrfUnit> unit;  ///< empty: not told
};

struct ColumnPlan {
  long header_line = 0;  ///< of the names; 0: none
  std::size_t frequency = 0;
  double to_hz = 1;
  std::vector<std::size_t> more_frequencies;  ///< the same numbers again, beside each entry
  std::vector<EntryColumns> entries;
};

/// By the names above row `first`, the first row of numbers, or by the number of columns where there are
/// none. Throws DataError.
ColumnPlan plan_columns(const Source& source, const std::vector<TableRow>& rows, std::size_t first,
                        const FrfChoice& choice);

/// True for a number, and for what programs write for a division by zero.
bool is_number(const std::string& field);
bool is_no_number(const std::string& field);

/// Columns of a row of numbers: empty fields at its end, and a unit behind the numbers, are none.
std::size_t number_of_columns(const TableRow& row);

/// Whether a field names the real or the imaginary part and nothing else.
bool part_at_end(const std::string& field);

/// The order in which the last fields of a row of numbers, but for a unit, name the two parts of a single
/// entry: true for `Imag Real`, false for `Real Imag`. Empty: they do not.
std::optional<bool> parts_at_end(const TableRow& row);

/// Throws DataError for a row with another number of columns than a table without names may have.
[[noreturn]] void refuse_column_count(const Source& source, const TableRow& row);

}  // namespace stablecut::document
