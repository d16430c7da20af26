// A document as tables of rows and columns, for spreadsheets and for the eye. ../README.md, "A document as
// tables".
#pragma once

#include <string>
#include <vector>

#include "document/text/json_text.h"

namespace stablecut::document {

struct FlatTable {
  std::string name;                     ///< where it stands in the document: `limit`, `fit/curves`
  std::vector<std::string> columns;     ///< names of fields, with their units
  std::vector<std::vector<Json>> rows;  ///< as many as columns each: numbers, texts, booleans; null: none
};

/// Every table of the document; the first, `document`, has its single values. Provenance is left out.
std::vector<FlatTable> flat_tables(const Json& document);

/// A line of names, then a line a row, separated by commas; texts quoted where they must be, null empty
/// [RFC4180], but for lines that end as in every other output.
std::string csv_text(const FlatTable& table);

struct TableSize {
  std::size_t rows, columns;
};

/// Columns of equal width, numbers rounded to six digits. Of a table of more rows or columns than `most` its
/// size only.
std::string aligned_text(const std::vector<FlatTable>& tables, const TableSize& most);

}  // namespace stablecut::document
