// Text forms that the tools' options share: numbers, FROM:TO:COUNT, X,Y,Z, index lists.
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

namespace stablecut {

/// `count` equally spaced values, both ends in; from = to when count is 1.
struct Range {
  double from = 0;
  double to = 0;
  int count = 1;

  /// Value i, increasing; the last is exactly `to`.
  double at(int i) const { return i + 1 == count ? to : from + (to - from) * i / (count - 1); }
  std::vector<double> values() const;
  double step() const { return count > 1 ? (to - from) / (count - 1) : 0; }
  bool is_point() const { return from == to; }
};

/// The parts between separators; one more than there are of these.
std::vector<std::string_view> split(std::string_view text, char separator);

/// A finite decimal number that fills the whole text, or nothing. The decimal mark is a point in every
/// locale.
std::optional<double> parse_number(std::string_view text);

/// A decimal integer that fills the whole text, or nothing.
std::optional<int> parse_integer(std::string_view text);

/// The most values of a range that is read.
inline constexpr int kMostInRange = 10'000'000;

/// `FROM:TO:COUNT` with finite FROM <= TO and COUNT from 1 to kMostInRange, FROM = TO exactly when COUNT is
/// 1, and all values finite as `at` forms them; else nothing.
std::optional<Range> parse_range(std::string_view text);

/// `LO:HI`, finite, LO < HI; else nothing. The count of the result is 2.
std::optional<Range> parse_band(std::string_view text);

/// `X,Y,Z`, three finite numbers; else nothing.
std::optional<std::array<double, 3>> parse_vector(std::string_view text);

/// `1-7,14-15`: 1-based indices, increasing and without repeats in the result; else nothing.
std::optional<std::vector<int>> parse_index_list(std::string_view text);

}  // namespace stablecut
