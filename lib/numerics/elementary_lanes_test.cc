#include "numerics/elementary_lanes.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "numerics/random.h"

using namespace stablecut;
using namespace stablecut::numerics;

TEST_CASE("sines and cosines are those of the library to 3e-16") {
  std::mt19937_64 generator(8);
  double worst = 0;
  for (int n = 0; n < 100000; ++n) {
    double angle[8], sine[8], cosine[8];
    const double range = n % 3 == 0 ? 1e5 : n % 3 == 1 ? 7 : 1e-3;
    for (double& a : angle) a = uniform(generator, -range, range);
    if (n == 0) angle[0] = 0;
    if (n < 100) angle[1] = n * kPi / 4;
    sines_and_cosines(angle, sine, cosine);
    for (int i = 0; i < 8; ++i) {
      worst =
          std::max({worst, std::abs(sine[i] - std::sin(angle[i])), std::abs(cosine[i] - std::cos(angle[i]))});
    }
  }
  CHECK(worst < 3e-16);
}

TEST_CASE("angles are those of the library to an ulp of pi, in every quadrant and on the axes") {
  std::mt19937_64 generator(12);
  double worst = 0;
  const auto compare = [&](const double y[4], const double x[4]) {
    double angle[4];
    store_lanes(angle_of(load_lanes<FourLanes>(y), load_lanes<FourLanes>(x)), angle);
    for (int i = 0; i < 4; ++i) worst = std::max(worst, std::abs(angle[i] - std::atan2(y[i], x[i])));
  };
  for (int n = 0; n < 100000; ++n) {
    double y[4], x[4];
    for (int i = 0; i < 4; ++i) {
      y[i] = uniform(generator, -1, 1);
      x[i] = uniform(generator, -1, 1) * (n % 2 == 0 ? 1 : 1e-6);
    }
    compare(y, x);
  }
  const double y[4] = {0, 1, 0, -1}, x[4] = {1, 0, -1, 0};
  compare(y, x);
  const double nothing[4] = {};
  compare(nothing, nothing);
  CHECK(worst < 4.5e-16);
}

TEST_CASE("the cosine of a third of a turn's sixth is the library's") {
  double worst = 0;
  for (int n = 0; n <= 3000; ++n) {
    double angle[4], cosine[4];
    for (int i = 0; i < 4; ++i) angle[i] = kPi / 3 * (n + 0.25 * i) / 3001;
    store_lanes(cosine_of_small(load_lanes<FourLanes>(angle)), cosine);
    for (int i = 0; i < 4; ++i) worst = std::max(worst, std::abs(cosine[i] - std::cos(angle[i])));
  }
  CHECK(worst < 2.3e-16);
}
