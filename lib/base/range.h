// Text forms that the tools' options share: numbers, FROM:TO:COUNT, index lists.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace stablecut {

/// `count` equally spaced values, both ends in; from = to when count is 1.
struct Range {
  double from = 0;
  double to = 0;
  int count = 1;

  /// The values, increasing; the last is exactly `to`.
  std::vector<double> values() const;
};

/// A finite decimal number that fills the whole text, or nothing. The decimal mark is a point in every
/// locale.
std::optional<double> parse_number(std::string_view text);

/// A decimal integer that fills the whole text, or nothing.
std::optional<int> parse_integer(std::string_view text);

/// `FROM:TO:COUNT` with finite FROM <= TO and COUNT >= 1, FROM = TO exactly when COUNT is 1; else nothing.
std::optional<Range> parse_range(std::string_view text);

/// `LO:HI`, finite, LO < HI; else nothing. The count of the result is 2.
std::optional<Range> parse_band(std::string_view text);

/// `1-7,14-15`: 1-based indices, increasing and without repeats in the result; else nothing.
std::optional<std::vector<int>> parse_index_list(std::string_view text);

}  // namespace stablecut
