#include "milling/operating_points.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "base/range.h"
#include "base/units.h"
#include "milling/lobes.h"
#include "milling/milling_fixtures_test.h"
#include "milling/spectral.h"
#include "milling/what_to_run.h"

using namespace stablecut;
using namespace stablecut::milling;

namespace {

// Lobes as a comb of valleys; the lowest of them between two chart speeds.
std::optional<double> valley(double speed) {
  const double depth = 2e-3 + 1e-3 * std::cos(speed / 10) + 1e-5 * speed;
  return depth < 4e-3 ? std::optional(depth) : std::nullopt;
}

std::optional<double> limit_of_valley(double speed, double top) {
  const auto depth = valley(speed);
  return depth && *depth < top ? depth : std::nullopt;
}

std::vector<LimitPoint> chart_of_valleys() {
  std::vector<LimitPoint> chart;
  for (double speed = 20; speed <= 200; speed += 6) chart.push_back({speed, valley(speed)});
  return chart;
}

}  // namespace

TEST_CASE("the unconditional limit lies between the chart's speeds") {
  const auto chart = chart_of_valleys();
  const auto limit_at = limit_of_valley;
  const auto found = unconditional_limit(chart, limit_at, 1);
  REQUIRE(found);
  double lowest = 1, at = 0;
  for (double speed = 20; speed < 200; speed += 0.01) {
    if (valley(speed) && *valley(speed) < lowest) lowest = *valley(at = speed);
  }
  CHECK(*found->depth_m == Approx(lowest).epsilon(1e-4));
  CHECK(found->revolutions_per_s == Approx(at).margin(0.3));
  CHECK(unconditional_limit(chart, limit_at, 2)->depth_m == found->depth_m);
  CHECK(!unconditional_limit({{10, {}}, {20, {}}}, limit_at, 1));
  CHECK(unconditional_limit({{31, valley(31)}}, limit_at, 1)->revolutions_per_s == 31);
}

// The flip of a lightly damped mode is 1 % of the speed wide: a coarse chart steps over it.
TEST_CASE("the unconditional limit finds a flip between the chart's speeds") {
  const TipStructure structure = tip_structure(fixtures::oscillator({"x", "y"}));
  const Cutter cutter = fixtures::benchmark_cutter(true, 0.05);
  const auto limit_at = [&](double speed, double top) -> std::optional<double> {
    const auto chart = stability_chart(structure, cutter, {speed}, {top}, {}, false, 1);
    const StabilityCrossing* limit = limit_of(chart.crossings.front());
    return limit != nullptr ? std::optional(limit->depth_m) : std::nullopt;
  };
  const auto found_on = [&](int speeds) {
    std::vector<double> all = Range{240, 390, speeds}.values();
    const std::vector<double> between = speeds_between({structure}, cutter, all, 3e-3, 1000);
    CHECK(between.size() + all.size() >= 46);  // log(390 / 240) over the damping ratio, 0.011
    all.insert(all.end(), between.begin(), between.end());
    std::sort(all.begin(), all.end());
    std::vector<LimitPoint> curve;
    for (const double speed : all) curve.push_back({speed, limit_at(speed, 20e-3)});
    return unconditional_limit(curve, limit_at, 2);
  };
  const auto coarse = found_on(4), fine = found_on(300);
  REQUIRE(coarse);
  REQUIRE(fine);
  CHECK(*coarse->depth_m == Approx(*fine->depth_m).epsilon(1e-3));
}

TEST_CASE("best points keep their margins, and power and torque limits") {
  const auto chart = chart_of_valleys();
  OperatingLimits limits;
  limits.largest_depth_m = 5e-3;
  const auto points = best_points(chart, limits, 3, limit_of_valley, 1);
  REQUIRE(points.size() == 3);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const OperatingPoint& point = points[i];
    if (i > 0)
      CHECK(point.depth_m * point.revolutions_per_s <=
            points[i - 1].depth_m * points[i - 1].revolutions_per_s);
    // Between the chart's speeds too.
    for (double share = -0.02; share <= 0.0201; share += 0.005) {
      const double speed = std::clamp(point.revolutions_per_s * (1 + share), 20.0, 200.0);
      CHECK(point.depth_m <= 0.9 * valley(speed).value_or(1) * (1 + 1e-9));
    }
    CHECK(point.slowest < point.fastest);
    CHECK(valley(point.slowest).value_or(1) >= point.depth_m);
    CHECK(valley(point.fastest).value_or(1) >= point.depth_m);
  }
  limits.largest_depth_times_speed = 0.1;
  REQUIRE(!best_points(chart, limits, 9, limit_of_valley, 2).empty());
  for (const OperatingPoint& point : best_points(chart, limits, 9, limit_of_valley, 2))
    CHECK(point.depth_m * point.revolutions_per_s <= 0.1 * (1 + 1e-12));
  limits.largest_depth_by_torque = 1e-3;
  REQUIRE(!best_points(chart, limits, 9, limit_of_valley, 2).empty());
  for (const OperatingPoint& point : best_points(chart, limits, 9, limit_of_valley, 2))
    CHECK(point.depth_m <= 1e-3);
  CHECK(best_points(chart, limits, 0, limit_of_valley, 1).empty());
}

const CuttingLoad kLoad{0.05e-3, 0, 0, 0, {}};

TEST_CASE("removal, power and torque of a cut") {
  Cutter cutter = fixtures::benchmark_cutter(true, 0.25, 2);
  cutter.diameter_m = 0.012;
  // 3 mm wide, 1 mm deep, 0.05 mm for each of two teeth, 100 turns a second: 30 mm3/s.
  const CutRate rate = cut_rate(cutter, kLoad, 100, 1e-3);
  CHECK(rate.removal_m3_per_s == Approx(30e-9));
  CHECK(rate.power_w == Approx(600e6 * 30e-9));
  CHECK(rate.torque_n_m == Approx(rate.power_w / (kTwoPi * 100)));
  // Edges of 20 N/mm rub over 60 degrees of each of 200 passes a second.
  const CutRate rubbed = cut_rate(cutter, {0.05e-3, 20e3, 0, 0, {}}, 100, 1e-3);
  CHECK(rubbed.power_w - rate.power_w == Approx(20e3 * 1e-3 * 0.006 * kPi / 3 * 200));
}

TEST_CASE("what to run keeps the chart's limits, and power and torque by the feed") {
  const TipStructure structure = tip_structure(fixtures::oscillator({"x"}));
  Cutter cutter = fixtures::benchmark_cutter(false, 1);
  cutter.diameter_m = 0.012;
  const std::vector<double> speeds = Range{8000.0 / 60, 20000.0 / 60, 25}.values();
  const auto chart = stability_chart(structure, cutter, speeds, {3e-3}, {}, false, 2);
  const LimitCurve curve = limit_curve(chart, speeds, StabilityMethod::kSpectral, 3e-3);
  RunRequest request;
  request.count = 3;
  const WhatToRun plain = what_to_run({structure}, cutter, curve, request, 2);
  REQUIRE(plain.unconditional);
  // The lowest limit of a slot between lobes.
  CHECK(*plain.unconditional->depth_m < 0.323e-3);
  CHECK(*plain.unconditional->depth_m > 0.3e-3);
  REQUIRE(plain.best.size() == 3);
  CHECK(plain.rates.empty());
  for (const OperatingPoint& point : plain.best) {
    for (const double share : {-0.02, -0.01, 0.0, 0.01, 0.02}) {
      const double speed = std::clamp(point.revolutions_per_s * (1 + share), speeds.front(), speeds.back());
      const SpectralMap map(structure, cutter, speed, 30);
      CHECK(spectral_radius(map, point.depth_m) < 1);
    }
  }
  request.load = kLoad;
  request.largest_power_w =
      0.5 * cut_rate(cutter, kLoad, plain.best[0].revolutions_per_s, plain.best[0].depth_m).power_w;
  const WhatToRun less = what_to_run({structure}, cutter, curve, request, 1);
  REQUIRE(less.rates.size() == less.best.size());
  REQUIRE(!less.best.empty());
  for (const CutRate& rate : less.rates) CHECK(rate.power_w <= *request.largest_power_w * (1 + 1e-12));
  CHECK(less.rates[0].power_w == Approx(*request.largest_power_w));
  request.largest_torque_n_m = 0.5 * less.rates[0].torque_n_m;
  const WhatToRun least = what_to_run({structure}, cutter, curve, request, 1);
  REQUIRE(!least.rates.empty());
  for (const CutRate& rate : least.rates) CHECK(rate.torque_n_m <= *request.largest_torque_n_m * (1 + 1e-12));
}
