#include "milling/lobes.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <catch2/catch.hpp>

#include "base/error.h"
#include "base/range.h"
#include "base/units.h"
#include "milling/milling_fixtures_test.h"
#include "milling/mode_limits.h"
#include "milling/spectral.h"
#include "milling/tested_cuts.h"

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

// Both tables are confirmed by scripts/derive/one_mode_limits.py, which shares no method with the library.
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

TEST_CASE("a lobe number is the whole number of waves, also where their product is whole but for rounding") {
  for (int waves = 0; waves < 300; ++waves) {
    for (double period_s = 1e-4; period_s < 1; period_s *= 1.37) {
      CHECK(lobe_number(waves / period_s, period_s) == waves);
      CHECK(lobe_number((waves + 0.001) / period_s, period_s) == waves);
      CHECK(lobe_number((waves + 0.999) / period_s, period_s) == waves);
    }
  }
}

// A mode of 922 Hz makes 5.5, 2.8 and 1.1 waves in a tooth period of these speeds, and chatters a little
// above its frequency in a slot.
TEST_CASE("lobe numbers of a slot count the waves of its mode") {
  const TipStructure structure = tip_structure(fixtures::oscillator({"x"}));
  const auto chart = stability_chart(structure, fixtures::benchmark_cutter(false, 1),
                                     {5000.0 / 60, 10000.0 / 60, 25000.0 / 60}, {5e-3}, {}, false, 1);
  const int expected[] = {5, 2, 1};
  for (std::size_t s = 0; s < 3; ++s) {
    const StabilityCrossing* limit = limit_of(chart.crossings[s]);
    REQUIRE(limit != nullptr);
    CHECK(limit->chatter_frequency_hz > 922);
    CHECK(limit->chatter_frequency_hz < 1.2 * 922);
    CHECK(limit->lobe == expected[s]);
  }
}

// With unequal pitches the motion may repeat with every revolution: four waves of it in one are two between
// teeth.
TEST_CASE("the lobe number of a fold is a whole number of waves") {
  const TipStructure structure = tip_structure(fixtures::oscillator({"x", "y"}));
  Cutter cutter = fixtures::benchmark_cutter(true, 0.05);
  cutter.pitch_rad = {0.8 * kPi, 1.2 * kPi};
  const std::vector<double> speeds = {14750.0 / 60, 15000.0 / 60};
  const auto chart = stability_chart(structure, cutter, speeds, {10e-3}, {}, false, 2);
  int folds = 0;
  for (std::size_t s = 0; s < speeds.size(); ++s) {
    for (const StabilityCrossing& crossing : chart.crossings[s]) {
      if (crossing.kind != Instability::kFold) continue;
      ++folds;
      CHECK(crossing.chatter_frequency_hz / speeds[s] == Approx(4).epsilon(1e-9));
      CHECK(crossing.lobe == 2);
    }
  }
  CHECK(folds == 4);
}

// A soft mode and a stiff one, a factor of 2.3 apart in frequency: each shakes the tip near its own
// frequency.
TEST_CASE("a crossing names the mode near its chatter frequency, and that mode alone has it too") {
  dynamics::ModalModel model = fixtures::oscillator({"x"});
  dynamics::Mode soft = model.modes[0];
  soft.frequency_hz = 400;
  soft.psi_l = soft.psi_r / std::complex<double>(0, 2 * 0.15 * soft.pole().imag());
  model.modes.push_back(soft);
  const Cutter cutter = fixtures::benchmark_cutter(false, 1);
  const std::vector<double> speeds = Range{4000.0 / 60, 20000.0 / 60, 9}.values();
  const auto chart = stability_chart(tip_structure(model), cutter, speeds, {3e-3}, {}, false, 2);
  int of_mode[] = {0, 0};
  for (std::size_t s = 0; s < speeds.size(); ++s) {
    for (const StabilityCrossing& crossing : chart.crossings[s]) {
      CHECK(crossing.mode == (crossing.chatter_frequency_hz > 650 ? 0 : 1));
      CHECK(crossing.participation > 0.6);
      ++of_mode[crossing.mode];
    }
  }
  CHECK(of_mode[0] >= 3);
  CHECK(of_mode[1] >= 3);

  const auto alone = limits_of_each_mode(model, {1, 0}, cutter, speeds, {3e-3}, {}, 2);
  REQUIRE(alone.size() == 2);
  for (const ModeLimit& limit : alone) {
    dynamics::ModalModel one = model;
    one.modes = {model.modes[limit.mode]};
    const auto own = stability_chart(tip_structure(one), cutter, speeds, {3e-3}, {}, false, 1);
    int limits = 0;
    for (std::size_t s = 0; s < speeds.size(); ++s) {
      REQUIRE(limit.crossings[s].size() == own.crossings[s].size());
      for (std::size_t c = 0; c < own.crossings[s].size(); ++c, ++limits) {
        CHECK(limit.crossings[s][c].depth_m == own.crossings[s][c].depth_m);
        CHECK(limit.crossings[s][c].mode == limit.mode);
      }
    }
    CHECK(limits >= 3);
  }
  CHECK(alone[0].mode == 1);
}

// The whole chart against one dense eigenvalue problem a point, with half as many points again.
TEST_CASE("a chart of many modes and teeth has the radii of a dense solver on a finer map", "[campaign]") {
  const TipStructure structure = tip_structure(fixtures::coupled_modes(60, 7));
  const Cutter cutter = fixtures::benchmark_cutter(true, 0.8, 8);
  const std::vector<double> speeds = {50.0, 120.0}, depths = Range{0, 1e-3, 5}.values();
  const auto chart = stability_chart(structure, cutter, speeds, depths, {}, true, 2);
  const double slowest = structure.lambda.real().maxCoeff();
  for (std::size_t s = 0; s < speeds.size(); ++s) {
    CHECK(chart.error[s] < 1e-7);
    CHECK(chart.spectral_radius(0, s) ==
          Approx(std::exp(slowest * cutter.tooth_period_s(speeds[s]))).epsilon(1e-6));
    const SpectralMap finer(structure, cutter, speeds[s], chart.resolution[s] * 3 / 2);
    for (std::size_t i = 0; i < depths.size(); ++i) {
      const double dense = Eigen::EigenSolver<Eigen::MatrixXd>(finer.monodromy(depths[i]), false)
                               .eigenvalues()
                               .cwiseAbs()
                               .maxCoeff();
      CHECK(std::abs(chart.spectral_radius(i, s) - dense) < 4e-7 * std::max(1.0, dense));
    }
  }
  CHECK(chart.spectral_radius.row(4).minCoeff() > 1);
}

TEST_CASE("tested cuts are judged at their own speed and depth") {
  const TipStructure structure = tip_structure(fixtures::oscillator({"x"}));
  const Cutter cutter = fixtures::benchmark_cutter(false, 1);
  // Either side of the limits 0.32238 mm at 10 000 rpm and 0.67639 mm at 8000 rpm.
  const std::vector<TestedCut> cuts = {{10000.0 / 60, 0.32e-3, true},
                                       {10000.0 / 60, 0.33e-3, true},
                                       {8000.0 / 60, 0.67e-3, false},
                                       {8000.0 / 60, 0.68e-3, {}}};
  const auto judged = judged_cuts(cuts, {structure}, cutter, {}, 2);
  REQUIRE(judged.size() == 4);
  for (std::size_t i = 0; i < cuts.size(); ++i) {
    CHECK(judged[i].stable == (i % 2 == 0));
    CHECK(judged[i].stable == (judged[i].spectral_radius < 1));
    CHECK(judged[i].error < 1e-8);
    CHECK(judged[i].agrees.has_value() == (i != 3));
  }
  CHECK(*judged[0].agrees);
  CHECK(!*judged[1].agrees);
  CHECK(!*judged[2].agrees);
}

TEST_CASE("a speed that cannot be resolved leaves the others as they are") {
  dynamics::ModalModel model = fixtures::oscillator({"x"});
  model.modes[0].frequency_hz = 50000;
  const TipStructure structure = tip_structure(model);
  const Cutter cutter = fixtures::benchmark_cutter(false, 1);
  const std::vector<double> depths = {0, 1e-3};
  const auto chart = stability_chart(structure, cutter, {20.0, 900.0}, depths, {}, true, 2);
  CHECK(!chart.failure[0].empty());
  CHECK(chart.failure[1].empty());
  CHECK(std::isnan(chart.spectral_radius(1, 0)));
  const auto alone = stability_chart(structure, cutter, {900.0}, depths, {}, true, 1);
  CHECK(chart.spectral_radius(1, 1) == alone.spectral_radius(1, 0));
  CHECK_THROWS_AS(stability_chart(structure, cutter, {20.0, 21.0}, depths, {}, true, 2), NoAnswer);
}
