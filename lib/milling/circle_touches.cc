#include "milling/circle_touches.h"

#include <algorithm>
#include <cmath>

#include "base/units.h"

namespace stablecut::milling {
namespace {

using Complex = std::complex<double>;

// Results that are one: radians, and share of the depth; and so many times what Newton's end leaves of the
// angle.
constexpr double kSamePlace = 1e-8, kSameEnd = 2;
// Newton's method finds both passages of a touch from where the search has them, where the imaginary part
// between is so many times what the search has wrong.
constexpr double kWellClear = 10;
// A touch is beyond doubt at so many times its change, and is not resolved further below this share of the
// eigenvalue (a pair: of its square).
constexpr double kWellAbove = 3, kRoundingOfTouch = 1e-12;

}  // namespace

std::vector<Start> starts_beside(const std::vector<CirclePassage>& touches) {
  std::vector<Start> starts;
  for (const CirclePassage& touch : touches) {
    const double extremum = touch.extremum(), between = -2 * extremum / touch.curvature;
    if (!(between > 0) || std::abs(extremum) > kWellClear * std::abs(extremum - touch.from.imag())) continue;
    for (const double side : {-1.0, 1.0}) {
      const double step = side * std::sqrt(between) - touch.slope.imag() / touch.curvature;
      const double angle = touch.angle + step;
      if (angle > 0 && angle < kPi) starts.push_back({angle, (touch.value + step * touch.slope).real()});
    }
  }
  return starts;
}

std::vector<RealPair> pairs_of_whole(const CircleOperator& whole, const std::vector<RealPair>& of_search,
                                     std::vector<Start>& starts) {
  std::vector<RealPair> result;
  for (const RealPair& pair : of_search) {
    const auto there = real_pair(whole, pair);
    if (!there) continue;
    result.push_back(*there);
    std::erase_if(starts, [&](const Start& start) {
      const double from_mean = start.value.real() - pair.mean;
      return start.seek == Seek::kAtOne && start.angle == pair.angle && pair.square > 0 &&
             std::abs(from_mean) < std::sqrt(pair.square) + kSamePlace * pair.mean;
    });
    if (there->square <= 0) continue;
    for (const double side : {-1.0, 1.0})
      starts.push_back({pair.angle, there->mean + side * std::sqrt(there->square), Seek::kAtOne});
  }
  return result;
}

bool are_one(const CirclePassage& a, const CirclePassage& b) {
  if (a.outwards != b.outwards || a.is_real() != b.is_real()) return false;
  double angle = kSamePlace, depth = kSamePlace;
  if (!a.is_real()) {
    // Where the axis is met at a small angle its passage is known less well.
    const double end = kSameEnd * kOnAxis * std::abs(a.value / a.slope.imag());
    angle += end;
    depth += end * std::abs(a.slope / a.value);
  }
  return std::abs(a.angle - b.angle) < angle && std::abs(a.depth_m - b.depth_m) < depth * b.depth_m;
}

bool are_doubtful(const CirclePassages& passages, const CircleOperator& finer,
                  const std::function<Complex(const CirclePassage&)>& value_there) {
  const auto doubtful = [](double left, double change, double size) {
    return std::abs(left) > kRoundingOfTouch * size && std::abs(left) < kWellAbove * std::abs(change);
  };
  const auto of_touch = [&](const CirclePassage& touch) {
    const double change = (value_there(touch) - touch.value).imag();
    return doubtful(touch.extremum(), change, std::abs(touch.value));
  };
  const auto of_pair = [&](const RealPair& pair) {
    const auto there = real_pair(finer, pair);
    return there && doubtful(pair.square, there->square - pair.square, pair.mean * pair.mean);
  };
  return std::any_of(passages.touches.begin(), passages.touches.end(), of_touch) ||
         std::any_of(passages.pairs.begin(), passages.pairs.end(), of_pair);
}

}  // namespace stablecut::milling
