#include "milling/lobes.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "base/range.h"
#include "base/units.h"
#include "milling/milling_fixtures_test.h"

using namespace stablecut;

namespace {

struct Published {
  double rpm;
  double depth_mm;
  Instability kind;
};

void check_limits(const TipStructure& structure, const Cutter& cutter, const std::vector<Published>& table) {
  for (const Published& row : table) {
    INFO(row.rpm << " rpm");
    const auto chart =
        stability_chart(structure, cutter, {revolutions_per_s_from_rpm(row.rpm)}, {5e-3}, {}, false, 1);
    REQUIRE(chart.limit[0]);
    CHECK(mm_from_metres(chart.limit[0]->depth_m) == Approx(row.depth_mm).epsilon(1e-4));
    CHECK(chart.limit[0]->critical.kind == row.kind);
    CHECK(std::abs(chart.limit[0]->critical.value) == Approx(1).margin(1e-6));
    CHECK(chart.error < 1e-8);
  }
}

constexpr auto kHopf = Instability::kHopf;
constexpr auto kFlip = Instability::kFlip;

}  // namespace

// The two tables of an independent code, computed for this project.
TEST_CASE("limit depths of the one-mode slot") {
  check_limits(tip_structure(fixtures::oscillator({"x"})), fixtures::benchmark_cutter(false, 1),
               {{5000, .40863, kHopf},
                {6000, .35322, kHopf},
                {7000, 1.15199, kHopf},
                {8000, .67639, kHopf},
                {9000, 3.00921, kHopf},
                {10000, .32238, kHopf},
                {12000, 2.14931, kFlip},
                {15000, .38659, kHopf},
                {20000, 1.41751, kFlip},
                {25000, 3.93993, kHopf}});
}

TEST_CASE("limit depths in two directions at 5 % immersion") {
  check_limits(tip_structure(fixtures::oscillator({"x", "y"})), fixtures::benchmark_cutter(true, 0.05),
               {{5000, 1.84380, kHopf},
                {6000, 1.53627, kHopf},
                {8000, 2.22940, kHopf},
                {10000, 1.48695, kHopf},
                {15000, 1.65121, kHopf},
                {20000, 3.25039, kFlip}});
}

TEST_CASE("a flip shakes at an odd multiple of half the tooth-passing frequency, near the mode") {
  const TipStructure structure = tip_structure(fixtures::oscillator({"x"}));
  const auto chart = stability_chart(structure, fixtures::benchmark_cutter(false, 1),
                                     {revolutions_per_s_from_rpm(20000), revolutions_per_s_from_rpm(10000)},
                                     {5e-3}, {}, false, 1);
  REQUIRE(chart.limit[0]);
  const double half = 20000.0 / 60;  // two teeth: half the tooth-passing frequency is the speed
  CHECK(chart.limit[0]->critical.chatter_frequency_hz == Approx(3 * half).epsilon(1e-6));
  REQUIRE(chart.limit[1]);
  CHECK(chart.limit[1]->critical.chatter_frequency_hz == Approx(940).margin(40));
}

TEST_CASE("the grid agrees with the limit, whatever the number of threads") {
  const TipStructure structure = tip_structure(fixtures::coupled_modes(5, 2));
  const Cutter cutter = fixtures::benchmark_cutter(true, 0.3);
  const std::vector<double> speeds = {80, 130, 200, 310};
  const std::vector<double> depths = Range{0, 4e-3, 41}.values();
  for (const auto method : {StabilityMethod::kSpectral, StabilityMethod::kSemiDiscretization}) {
    const auto chart = stability_chart(structure, cutter, speeds, depths, {method, 20}, true, 1);
    const auto threaded = stability_chart(structure, cutter, speeds, depths, {method, 20}, true, 2);
    CHECK(chart.spectral_radius == threaded.spectral_radius);
    int crossings = 0;
    for (std::size_t s = 0; s < speeds.size(); ++s) {
      for (std::size_t i = 0; i < depths.size(); ++i) {
        const double radius =
            chart.spectral_radius(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(s));
        if (chart.limit[s] && depths[i] < chart.limit[s]->depth_m) CHECK(radius <= 1);
        if (!chart.limit[s]) CHECK(radius <= 1);
      }
      if (chart.limit[s]) {
        ++crossings;
        CHECK(threaded.limit[s]->depth_m == chart.limit[s]->depth_m);
        const auto first_above = std::find_if(depths.begin(), depths.end(),
                                              [&](double depth) { return depth > chart.limit[s]->depth_m; });
        REQUIRE(first_above != depths.end());
        CHECK(chart.spectral_radius(first_above - depths.begin(), static_cast<Eigen::Index>(s)) > 1);
      }
    }
    CHECK(crossings >= 2);
  }
}
