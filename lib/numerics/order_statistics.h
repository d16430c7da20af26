// Medians and quantiles of samples.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace stablecut::numerics {

/// The middle one, the upper of two; at least one value.
inline double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// The value below which a share of the sorted values lies, each standing for the middle of its share,
/// interpolated between the nearest two [HyndmanFan1996, definition 5]; none where that is infinite.
inline std::optional<double> quantile(const std::vector<double>& sorted, double share) {
  const double place = share * static_cast<double>(sorted.size()) - 0.5;
  const auto last = static_cast<double>(sorted.size() - 1);
  const double below = std::clamp(std::floor(place), 0.0, last), above = std::min(below + 1, last);
  const double low = sorted[static_cast<std::size_t>(below)], high = sorted[static_cast<std::size_t>(above)];
  if (!std::isfinite(high)) return std::isfinite(low) && place <= below ? std::optional(low) : std::nullopt;
  return low + std::clamp(place - below, 0.0, 1.0) * (high - low);
}

}  // namespace stablecut::numerics
