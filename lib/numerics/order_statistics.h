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

/// The same of values in any order that have weights, at least one of them above 0: each stands for the
/// middle of its share of the weight.
inline double weighted_quantile(const std::vector<double>& values, const std::vector<double>& weights,
                                double share) {
  std::vector<std::size_t> order;
  double all = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (weights[i] > 0) order.push_back(i);
    all += weights[i];
  }
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  double before = 0, place = 0, value = values[order.front()];
  for (const std::size_t i : order) {
    const double here = (before + weights[i] / 2) / all;
    if (here >= share)
      return here > place ? value + (share - place) / (here - place) * (values[i] - value) : values[i];
    before += weights[i];
    place = here;
    value = values[i];
  }
  return value;
}

}  // namespace stablecut::numerics
