#include "document/measured/universal_lines.h"

#include <algorithm>

#include "base/range.h"
#include "document/text/plain_text.h"

namespace stablecut::document {

LineReader::LineReader(std::string_view text) : rest_(text) {
  if (rest_.starts_with("\xEF\xBB\xBF")) rest_.remove_prefix(3);  // a byte-order mark
}

std::optional<std::string_view> LineReader::next() {
  if (rest_.empty()) return std::nullopt;
  const auto end = rest_.find('\n');
  const std::string_view line = rest_.substr(0, end);
  rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
  ++line_;
  return line;
}

void LineReader::skip(std::size_t bytes) {
  const std::string_view passed = rest_.substr(0, bytes);
  line_ += std::count(passed.begin(), passed.end(), '\n');
  rest_.remove_prefix(passed.size());
}

bool is_delimiter(std::string_view line) { return trimmed(line) == "-1"; }

void skip_dataset(LineReader& lines) {
  while (const auto line = lines.next()) {
    if (is_delimiter(*line)) return;
  }
}

std::vector<LineWord> words_of(std::string_view line) {
  std::vector<LineWord> words;
  for (std::size_t at = line.find_first_not_of(kBlanks); at != std::string_view::npos;) {
    const auto end = line.find_first_of(kBlanks, at);
    words.push_back({line.substr(at, end - at), at});
    at = end == std::string_view::npos ? end : line.find_first_not_of(kBlanks, end);
  }
  return words;
}

std::string_view columns_of(std::string_view line, std::size_t from, std::size_t to) {
  return from > line.size() ? std::string_view() : line.substr(from - 1, to - from + 1);
}

std::optional<int> field_integer(std::string_view field) {
  field = trimmed(field);
  return field.empty() ? std::optional(0) : parse_integer(field);
}

std::string field_name(std::string_view field) {
  const std::string name(trimmed(field));
  return lower(name) == "none" ? "" : name;
}

}  // namespace stablecut::document
