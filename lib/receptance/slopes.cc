#include "receptance/slopes.h"

#include <array>
#include <cmath>
#include <optional>
#include <string>

#include "base/error.h"

namespace stablecut::receptance {
namespace {

using Complex = std::complex<double>;

std::string direction_name(int direction) { return kCoordinates[2 * direction]; }

// From entries with slopes; a missing one of l and n is taken by reciprocity where response and load have one
// direction.
std::optional<DirectionBlock> measured_slopes(const Taps& taps, int d, int e) {
  std::array<const Tap*, 4> entry{};
  for (int i = 0; i < 4; ++i) entry[i] = tap_at(taps, 2 * d + i / 2, 2 * e + i % 2, 0, 0);
  if (d == e && entry[1] == nullptr) entry[1] = entry[2];
  if (d == e && entry[2] == nullptr) entry[2] = entry[1];
  if (entry[1] == nullptr || entry[2] == nullptr) return std::nullopt;
  if (entry[0] == nullptr || entry[3] == nullptr) {
    throw InvalidArgument(
        direction_name(d) + direction_name(e) +
        ": entries with slopes: expected deflection and slope, each by force and by moment");
  }
  DirectionBlock block{std::vector<Receptance<2>>(entry[0]->h.size()), entry[1]->variance};
  for (std::size_t i = 0; i < block.value.size(); ++i) {
    const Eigen::Index at = i;
    block.value[i] << entry[0]->h[at], entry[1]->h[at], entry[2]->h[at], entry[3]->h[at];
  }
  return block;
}

// The one place besides 0 at which a pair of directions was tapped; 0 when there is none.
double spacing_of(const Taps& taps, int d, int e) {
  double spacing = 0;
  for (const Tap& tap : taps) {
    if (!tap.is_of(2 * d, 2 * e)) continue;
    for (const double place : {tap.response_m, tap.reference_m}) {
      if (place < -kSamePlace)
        throw InvalidArgument(direction_name(d) + ": a position below 0: expected a distance from the tip");
      if (place < kSamePlace) continue;
      if (spacing > 0 && std::abs(place - spacing) > kSamePlace)
        throw InvalidArgument(direction_name(d) + direction_name(e) +
                              ": more than two places: expected 0 and one other for a finite difference");
      spacing = place;
    }
  }
  return spacing;
}

std::optional<DirectionBlock> difference_slopes(const Taps& taps, int d, int e) {
  const double spacing = spacing_of(taps, d, e);
  const auto tap = [&](double a, double b) { return tap_at(taps, 2 * d, 2 * e, a, b); };
  const Tap *direct = tap(0, 0), *of_moment = tap(0, spacing), *of_slope = tap(spacing, 0);
  if (spacing == 0 || direct == nullptr || (of_moment == nullptr && of_slope == nullptr)) return std::nullopt;
  if (of_moment == nullptr) of_moment = of_slope;
  if (of_slope == nullptr) of_slope = of_moment;
  const Tap* far = tap(spacing, spacing);
  DirectionBlock block{std::vector<Receptance<2>>(direct->h.size()),
                       (direct->variance + of_moment->variance) / (spacing * spacing), spacing,
                       far != nullptr};
  for (std::size_t i = 0; i < block.value.size(); ++i) {
    const Eigen::Index at = i;
    const Complex h = direct->h[at], l = (h - of_moment->h[at]) / spacing,
                  n = (h - of_slope->h[at]) / spacing;
    Complex p = h == 0.0 ? 0.0 : l * n / h;
    if (far != nullptr) p = (h - of_moment->h[at] - of_slope->h[at] + far->h[at]) / (spacing * spacing);
    block.value[i] << h, l, n, p;
  }
  return block;
}

}  // namespace

DirectionBlock block_with_slopes(const Taps& taps, int d, int e) {
  if (auto block = measured_slopes(taps, d, e)) return *block;
  if (auto block = difference_slopes(taps, d, e)) return *block;
  throw InvalidArgument(direction_name(d) + direction_name(e) +
                        ": no slopes and no second place: expected entries with slope_" + direction_name(d) +
                        ", or taps at the positions 0 and one other");
}

}  // namespace stablecut::receptance
