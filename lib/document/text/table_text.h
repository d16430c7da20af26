// Columns of numbers as spreadsheets and analysers write them: CSV, TSV, blanks.
#pragma once

#include <string>
#include <vector>

#include "document/text/json_text.h"

namespace stablecut::document {

/// One line of fields. Blank lines and lines that begin with #, %, ! or // are not rows.
struct TableRow {
  long line = 0;  ///< 1-based
  std::vector<std::string> fields;
};

/// The rows of the text. The separator is the first of tab, semicolon, bar, comma that the last line holds,
/// else blanks, or what a first line `sep=;` says. CRLF, a byte-order mark and quotes around a field are
/// taken off, and tabs by which all lines are indented; a separator inside quotes is none. A comma inside a
/// field is read as a point where the field is then a number.
std::vector<TableRow> table_rows(const Source& source);

/// True when no field of the row is a number: a header.
bool is_header(const TableRow& row);

/// Field `column` as a finite number. Throws DataError naming line, column and what was expected.
double table_number(const Source& source, const TableRow& row, std::size_t column, const char* expected);

}  // namespace stablecut::document
