// The lines of a universal file, and the fields of a line.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace stablecut::document {

/// Goes through a text line by line; the text must outlive it and what it gives.
class LineReader {
 public:
  explicit LineReader(std::string_view text);

  /// The next line without its end, or nothing behind the last.
  std::optional<std::string_view> next();
  /// 1-based number of the line that next() gave last; 0 before the first.
  long line() const { return line_; }
  /// What has not been read.
  std::string_view rest() const { return rest_; }
  /// Passes over that many bytes, counting their lines.
  void skip(std::size_t bytes);

 private:
  std::string_view rest_;
  long line_ = 0;
};

/// True for a line that holds -1 alone, which begins and ends a dataset.
bool is_delimiter(std::string_view line);
/// Reads up to the next delimiter, or to the end.
void skip_dataset(LineReader& lines);

/// A word of a line, and the index of its first character there.
struct LineWord {
  std::string_view text;
  std::size_t at = 0;
};
/// What stands between blanks.
std::vector<LineWord> words_of(std::string_view line);

/// Columns `from` to `to` of a line, 1-based, both in; shorter or empty where the line ends before.
std::string_view columns_of(std::string_view line, std::size_t from, std::size_t to);
/// A field of fixed columns as a whole number; 0 for a blank field, as Fortran reads it.
std::optional<int> field_integer(std::string_view field);
/// A field of text without blanks at its ends; empty for NONE.
std::string field_name(std::string_view field);

}  // namespace stablecut::document
