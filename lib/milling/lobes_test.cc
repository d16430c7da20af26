#include "milling/lobes.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "base/range.h"
#include "base/units.h"
#include "milling/milling_fixtures_test.h"

using namespace stablecut;
using namespace stablecut::milling;

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
    const StabilityCrossing* limit = limit_of(chart.crossings[0]);
    REQUIRE(limit != nullptr);
    CHECK(mm_from_metres(limit->depth_m) == Approx(row.depth_mm).epsilon(1e-4));
    CHECK(limit->kind == row.kind);
    CHECK(chart.error[0] < 1e-8);
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
  REQUIRE(limit_of(chart.crossings[0]) != nullptr);
  const double half = 20000.0 / 60;  // two teeth: half the tooth-passing frequency is the speed
  CHECK(limit_of(chart.crossings[0])->chatter_frequency_hz == Approx(3 * half).epsilon(1e-6));
  REQUIRE(limit_of(chart.crossings[1]) != nullptr);
  CHECK(limit_of(chart.crossings[1])->chatter_frequency_hz == Approx(940).margin(40));
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
    int limits = 0;
    for (std::size_t s = 0; s < speeds.size(); ++s) {
      REQUIRE(threaded.crossings[s].size() == chart.crossings[s].size());
      for (std::size_t c = 0; c < chart.crossings[s].size(); ++c) {
        CHECK(threaded.crossings[s][c].depth_m == chart.crossings[s][c].depth_m);
        CHECK(chart.crossings[s][c].unstable_above == (c % 2 == 0));
        CHECK(chart.crossings[s][c].participation > 0.2);
      }
      for (std::size_t i = 0; i < depths.size(); ++i) {
        // As many crossings below as it takes.
        const auto below = std::count_if(chart.crossings[s].begin(), chart.crossings[s].end(),
                                         [&](const StabilityCrossing& c) { return c.depth_m < depths[i]; });
        CHECK((chart.spectral_radius(i, s) > 1) == (below % 2 == 1));
      }
      if (limit_of(chart.crossings[s]) != nullptr) ++limits;
    }
    CHECK(limits >= 2);
  }
}

// A lobe's chatter frequency rises with the speed and falls from one lobe to the next: the number counts the
// waves between teeth.
TEST_CASE("lobe numbers count the waves, and the only mode drives them all") {
  const TipStructure structure = tip_structure(fixtures::oscillator({"x"}));
  const Cutter cutter = fixtures::benchmark_cutter(false, 1);
  const auto chart =
      stability_chart(structure, cutter, {5000.0 / 60, 10000.0 / 60, 25000.0 / 60}, {5e-3}, {}, false, 1);
  for (std::size_t s = 0; s < 3; ++s) {
    const StabilityCrossing* limit = limit_of(chart.crossings[s]);
    REQUIRE(limit != nullptr);
    const double waves =
        limit->chatter_frequency_hz * cutter.tooth_period_s(std::vector{5000.0, 10000.0, 25000.0}[s] / 60);
    CHECK(limit->lobe == static_cast<int>(waves));
    CHECK(limit->participation == Approx(1));
    CHECK(limit->mode == 0);
  }
  CHECK(limit_of(chart.crossings[0])->lobe > limit_of(chart.crossings[1])->lobe);
  CHECK(limit_of(chart.crossings[1])->lobe > limit_of(chart.crossings[2])->lobe);
}

TEST_CASE("a chart of many modes and teeth") {
  const TipStructure structure = tip_structure(fixtures::coupled_modes(60, 7));
  const Cutter cutter = fixtures::benchmark_cutter(true, 0.8, 8);
  const auto chart =
      stability_chart(structure, cutter, {50.0, 120.0}, Range{0, 1e-3, 5}.values(), {}, true, 2);
  CHECK(chart.error[0] < 1e-7);
  CHECK(chart.spectral_radius(0, 0) < 1);
}
