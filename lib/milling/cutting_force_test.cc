#include "milling/cutting_force.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "base/units.h"
#include "milling/milling_fixtures_test.h"
#include "numerics/random.h"

using namespace stablecut;
using namespace stablecut::milling;

namespace {

// Of the benchmark: Kt = 600, Kr = 200 N/mm2; Ka = 150.
Cutter cutter_of(int teeth, double entry_deg, double exit_deg) {
  Cutter cutter = fixtures::benchmark_cutter(true, 1, teeth);
  cutter.entry_rad = radians_from_degrees(entry_deg);
  cutter.exit_rad = radians_from_degrees(exit_deg);
  cutter.ka_n_per_m2 = 150e6;
  return cutter;
}

constexpr double kFeed = 0.1e-3;
const CuttingLoad kLoad{kFeed, 20e3, 30e3, 5e3, {}};

// The force of straight teeth at a turn, written out: each tooth cuts what the teeth before it have left.
Eigen::Vector3d plain_force(const Cutter& cutter, const CuttingLoad& load, double turn) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double place = 0;
  for (int j = 0; j < cutter.teeth; ++j) {
    const double phi = turn - place - std::floor((turn - place) / kTwoPi) * kTwoPi;
    const auto pitch = [&](int tooth) {
      return cutter.equal_pitch() ? kTwoPi / cutter.teeth : cutter.pitch_rad[tooth];
    };
    const auto out = [&](int tooth) { return load.runout_m.empty() ? 0 : load.runout_m[tooth]; };
    place += pitch(j);
    if (phi < cutter.entry_rad || phi > cutter.exit_rad) continue;
    double chip = 1, back = 0;
    for (int m = 1; m <= cutter.teeth; ++m) {
      const int other = (j + cutter.teeth - m) % cutter.teeth;
      back += pitch(other);
      chip = std::min(
          chip, load.feed_per_tooth_m * cutter.teeth * back / kTwoPi * std::sin(phi) + out(j) - out(other));
    }
    if (chip <= 0) continue;
    const double along = cutter.kt_n_per_m2 * chip + load.kte_n_per_m,
                 across = cutter.kr_n_per_m2 * chip + load.kre_n_per_m;
    sum += Eigen::Vector3d(-std::cos(phi) * along - std::sin(phi) * across,
                           std::sin(phi) * along - std::cos(phi) * across,
                           cutter.ka_n_per_m2 * chip + load.kae_n_per_m);
  }
  return sum;
}

}  // namespace

TEST_CASE("mean force of a slot: the average force model") {
  // [Altintas2012]: with N a / 4 and N a / pi.
  for (const int teeth : {1, 2, 3, 5}) {
    const Cutter cutter = cutter_of(teeth, 0, 180);
    const double depth = 2e-3;
    const ForceParts force = depth * force_cycle(cutter, kLoad, 1e-3).mean();
    const double quarter = teeth * depth / 4, edge = teeth * depth / kPi;
    CHECK(force.x() == Approx(-quarter * 200e6 * kFeed - edge * 30e3).epsilon(1e-12));
    CHECK(force.y() == Approx(quarter * 600e6 * kFeed + edge * 20e3).epsilon(1e-12));
    CHECK(force.z() == Approx(edge * 150e6 * kFeed + teeth * depth / 2 * 5e3).epsilon(1e-12));
    // Along the cut: Kt times the chips' area, and the edges over half a turn.
    CHECK(force[3] == Approx(edge * 600e6 * kFeed + teeth * depth / 2 * 20e3).epsilon(1e-12));
  }
}

TEST_CASE("force at a turn and its integral, also with unequal pitches and runout") {
  std::mt19937_64 generator(3);
  for (int n = 0; n < 40; ++n) {
    const int teeth = 1 + n % 5;
    const double entry = n % 3 == 0 ? 0 : numerics::uniform(generator, 0, 80);
    Cutter cutter = cutter_of(teeth, entry, n % 4 == 0 ? 180 : numerics::uniform(generator, 90, 180));
    CuttingLoad load = kLoad;
    if (n % 2 == 1 && teeth > 1) {
      double sum = 0;
      for (int j = 0; j < teeth; ++j) cutter.pitch_rad.push_back(numerics::uniform(generator, 0.6, 1.4));
      for (const double pitch : cutter.pitch_rad) sum += pitch;
      for (double& pitch : cutter.pitch_rad) pitch *= kTwoPi / sum;
    }
    if (n % 4 > 1) {
      // Up to twice the feed, so that teeth come that cut little or nothing.
      for (int j = 0; j < teeth; ++j)
        load.runout_m.push_back(numerics::uniform(generator, -1, 1) * kFeed * (n % 8 > 3 ? 1 : 0.1));
    }
    const ForceCycle cycle = force_cycle(cutter, load, 1e-3);
    const double size = cutter.kt_n_per_m2 * kFeed * teeth;
    INFO("case " << n);
    for (int i = 0; i < 50; ++i) {
      const double turn = numerics::uniform(generator, -10, 10);
      const ForceParts force = sum_at(cycle.arcs, cycle.period_rad, turn);
      CHECK((force.head<3>() - plain_force(cutter, load, turn)).norm() < 1e-9 * size);
    }
    // By the midpoint rule, whose error where a tooth enters or leaves is a step's force.
    const double from = numerics::uniform(generator, -6, 0), to = numerics::uniform(generator, 0, 6);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    constexpr int kSteps = 20000;
    for (int i = 0; i < kSteps; ++i)
      sum += plain_force(cutter, load, from + (to - from) * (i + 0.5) / kSteps) * (to - from) / kSteps;
    const ForceParts integral =
        integral_to(cycle.arcs, cycle.period_rad, to) - integral_to(cycle.arcs, cycle.period_rad, from);
    CHECK((integral.head<3>() - sum).norm() < 1e-2 * size);
  }
}

TEST_CASE("feed and work do not depend on runout as long as all teeth cut") {
  const Cutter cutter = cutter_of(3, 30, 140);
  CuttingLoad load = kLoad;
  const ForceParts plain = force_cycle(cutter, load, 1e-3).mean();
  load.runout_m = {4e-6, -5e-6, 1e-6};
  CHECK((plain - force_cycle(cutter, load, 1e-3).mean()).norm() < 1e-12 * plain.norm());
  // One tooth far out does the work of all, in chips three times as thick.
  load.runout_m = {0, 0, 1e-3};
  load.kte_n_per_m = load.kre_n_per_m = load.kae_n_per_m = 0;
  Cutter one = cutter;
  one.teeth = 1;
  CuttingLoad thick = load;
  thick.runout_m.clear();
  thick.feed_per_tooth_m *= 3;
  CHECK((force_cycle(cutter, load, 1e-3).mean() - force_cycle(one, thick, 1e-3).mean()).norm() <
        1e-12 * plain.norm());
}
