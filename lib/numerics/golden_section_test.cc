#include "numerics/golden_section.h"

#include <catch2/catch.hpp>
#include <cmath>

using namespace stablecut::numerics;

namespace {

struct Point {
  double x, value;
};

// Of a function whose least value lies at `bottom`, from a first point inside.
Point least_of(double bottom, double first, int steps, int& calls, double enough) {
  const auto at = [&](double x) {
    ++calls;
    return Point{x, std::abs(x - bottom)};
  };
  return golden_section(
      0, 1, at(first), steps, [](const Point& p) { return p.x; }, at,
      [](const Point& a, const Point& b) { return a.value < b.value; },
      [&](const Point& p) { return p.value < enough; });
}

}  // namespace

TEST_CASE("each step leaves 0.618 of the stretch, wherever the bottom is") {
  for (const double bottom : {0.0, 0.01, 0.4, 0.77, 1.0}) {
    int calls = 0;
    const Point least = least_of(bottom, kGoldenShare, 30, calls, 0);
    CHECK(least.value < std::pow(0.6180339887498949, 30));
    CHECK(calls == 31);
  }
}

TEST_CASE("it stops as soon as a point is good enough") {
  int calls = 0;
  CHECK(least_of(0.77, kGoldenShare, 30, calls, 0.1).value < 0.1);
  CHECK(calls < 5);
}
