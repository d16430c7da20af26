#include "base/range.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

namespace stablecut {
namespace {

template <typename T>
std::optional<T> parse_whole(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (;;) {
    const auto end = text.find(separator);
    parts.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

std::vector<double> Range::values() const {
  std::vector<double> result(count);
  for (int i = 0; i < count; ++i) {
    result[i] = at(i);
  }
  return result;
}

std::optional<double> parse_number(std::string_view text) {
  const auto value = parse_whole<double>(text);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

std::optional<int> parse_integer(std::string_view text) { return parse_whole<int>(text); }

std::optional<Range> parse_range(std::string_view text) {
  const auto parts = split(text, ':');
  if (parts.size() != 3) return std::nullopt;
  const auto from = parse_number(parts[0]);
  const auto to = parse_number(parts[1]);
  const auto count = parse_integer(parts[2]);
  if (!from || !to || !count || *count < 1 || *count > kMostInRange) return std::nullopt;
  if (*count == 1 ? *from != *to : !(*from < *to)) return std::nullopt;
  if (!std::isfinite((*to - *from) * *count)) return std::nullopt;
  return Range{*from, *to, *count};
}

std::optional<Range> parse_band(std::string_view text) {
  const auto parts = split(text, ':');
  if (parts.size() != 2) return std::nullopt;
  const auto from = parse_number(parts[0]);
  const auto to = parse_number(parts[1]);
  if (!from || !to || !(*from < *to)) return std::nullopt;
  return Range{*from, *to, 2};
}

std::optional<std::array<double, 3>> parse_vector(std::string_view text) {
  const auto parts = split(text, ',');
  if (parts.size() != 3) return std::nullopt;
  std::array<double, 3> vector{};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto number = parse_number(parts[i]);
    if (!number) return std::nullopt;
    vector[i] = *number;
  }
  return vector;
}

std::optional<std::vector<int>> parse_index_list(std::string_view text) {
  constexpr int kLargest = 1'000'000;
  std::vector<std::pair<int, int>> intervals;
  for (const auto part : split(text, ',')) {
    const auto ends = split(part, '-');
    const auto first = parse_integer(ends.front());
    const auto last = parse_integer(ends.back());
    if (ends.size() > 2 || !first || !last || *first < 1 || *last < *first || *last > kLargest) {
      return std::nullopt;
    }
    intervals.emplace_back(*first, *last);
  }
  // Each index once, however often it is named.
  std::sort(intervals.begin(), intervals.end());
  std::vector<int> indices;
  for (const auto& [first, last] : intervals) {
    for (int i = std::max(first, indices.empty() ? 1 : indices.back() + 1); i <= last; ++i)
      indices.push_back(i);
  }
  return indices;
}

}  // namespace stablecut
