#include "milling/cut_simulation.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "base/units.h"
#include "milling/limits.h"
#include "milling/milling_fixtures_test.h"
#include "milling/period.h"
#include "milling/spectral.h"
#include "milling/surface.h"
#include "numerics/random.h"

using namespace stablecut;
using namespace stablecut::milling;

namespace {

const CuttingLoad kLoad{0.1e-3, 20e3, 30e3, 5e3, {}};

struct RandomCut {
  TipStructure structure;
  Cutter cutter;
  double speed, depth;

  double radius(double share = 1) const {
    const double at = share * depth;
    return spectral_radius(*prepare_period(structure, cutter, speed, {}, at).map, at);
  }
  // Whether 5 % of the depth more or less change the verdict.
  bool near_limit(double here) const {
    const auto other = [&](double share) { return (radius(share) < 1) != (here < 1); };
    return std::abs(here - 1) < 0.2 && (other(1.05) || other(1 / 1.05));
  }
};

// Cuts of 1 to 15 modes, 1 to 4 teeth, any immersion and feed; `kind` 1: unequal pitch, 2: helix, 3: process
// damping.
RandomCut random_cut(int n, int kind, std::mt19937_64& generator) {
  const auto uniform = [&](double from, double to) { return numerics::uniform(generator, from, to); };
  RandomCut cut{tip_structure(fixtures::coupled_modes(1 + n % 15, static_cast<unsigned>(n + 1))), {}, 0, 0};
  const int teeth = 1 + (n / 3) % 4;
  cut.cutter = fixtures::benchmark_cutter(n % 2 == 0, n % 5 == 0 ? 1 : uniform(0.05, 1), teeth);
  cut.cutter.diameter_m = 10e-3;
  cut.cutter.feed_angle_rad = uniform(-3, 3);
  cut.speed = uniform(40, 250);
  cut.depth = std::exp(uniform(std::log(0.05e-3), std::log(2e-3)));
  if (kind == 1 && teeth > 1) {
    double sum = 0;
    for (int j = 0; j < teeth; ++j) cut.cutter.pitch_rad.push_back(uniform(0.8, 1.2));
    for (const double pitch : cut.cutter.pitch_rad) sum += pitch;
    for (double& pitch : cut.cutter.pitch_rad) pitch *= kTwoPi / sum;
  }
  if (kind == 2) cut.cutter.lag_rad_per_m = uniform(-100, 200);
  if (kind == 3) {
    cut.cutter.damping_n_per_m = 3e4;
    cut.cutter.damping_friction = 0.3;
  }
  return cut;
}

}  // namespace

TEST_CASE("a growth nearer to 1 than its error leaves the verdict open") {
  const auto open = [](double per_tooth, double error) {
    SimulationResult result;
    result.growth.per_tooth = per_tooth;
    result.growth.error = error;
    return result.is_open();
  };
  CHECK(open(1.001, 2e-3));
  CHECK(open(0.999, 2e-3));
  CHECK(open(1, 0));
  CHECK_FALSE(open(1.01, 2e-3));
  CHECK_FALSE(open(0.99, 2e-3));
  CHECK_FALSE(open(2, 0.4));
}

TEST_CASE("simulated deviations grow as the spectral radius says", "[campaign]") {
  std::mt19937_64 generator(7);
  int cuts = 0, far = 0, agree = 0;
  for (int n = 0; n < 300; ++n) {
    const RandomCut cut = random_cut(n, n % 7 < 4 ? 0 : n % 7 - 3, generator);
    const double radius = cut.radius();
    if (radius > 100) continue;  // nobody needs its digits, and the maps' points are not chosen for it
    ++cuts;
    const SimulatedGrowth growth = simulated_growth(cut.structure, cut.cutter, kLoad, cut.speed, cut.depth);
    INFO("cut " << n << ": " << growth.per_tooth << ", " << radius);
    // To 1 %: the steps are chosen for 0.1 %, and then extrapolated.
    CHECK(std::abs(growth.per_tooth / radius - 1) < 1e-3);
    const bool stable = radius < 1;
    if (cut.near_limit(radius)) continue;
    ++far;
    agree += (growth.per_tooth < 1) == stable;
  }
  CHECK(cuts > 270);
  CHECK(far > 250);
  CHECK(agree >= 0.99 * far);
}

TEST_CASE("a force that changes the velocity at once does so for the flanks of all teeth in cut",
          "[campaign]") {
  // Modes of no structure with mass, process damping, and unequal pitches of which several are in cut.
  const TipStructure structure = tip_structure(fixtures::coupled_modes(3, 8));
  for (const auto& [up, immersion, speed] : {std::tuple{true, 0.9, 90.0}, std::tuple{false, 1.0, 140.0}}) {
    Cutter cutter = fixtures::benchmark_cutter(up, immersion, 4);
    cutter.diameter_m = 10e-3;
    cutter.pitch_rad = {1.4, 1.65, 1.5, kTwoPi - 4.55};
    cutter.damping_n_per_m = 1e5;
    cutter.damping_friction = 0.3;
    int unstable = 0;
    for (const double depth : {0.15e-3, 0.9e-3}) {
      const double radius = spectral_radius(*prepare_period(structure, cutter, speed, {}, depth).map, depth);
      unstable += radius > 1;
      const SimulatedGrowth growth = simulated_growth(structure, cutter, kLoad, speed, depth);
      INFO(speed << " rev/s, " << depth << " m: " << growth.per_tooth << ", " << radius);
      CHECK(std::abs(growth.per_tooth / radius - 1) < 1e-4);
    }
    CHECK(unstable > 0);
  }
}

TEST_CASE("the simulated motion settles where the cut is stable, and nowhere else", "[campaign]") {
  std::mt19937_64 generator(8);
  int far = 0, agree = 0;
  for (int n = 0; n < 120; ++n) {
    const int kind = n % 4;
    const RandomCut cut = random_cut(n, kind, generator);
    const double radius = cut.radius();
    const bool stable = radius < 1;
    if (radius > 100 || cut.near_limit(radius)) continue;
    const SimulationResult result =
        simulate_cut(cut.structure, cut.cutter, kLoad, {cut.speed, cut.depth, {}, {}, false});
    if (!result.keeps_contact) continue;
    ++far;
    agree += result.settled == stable;
    if (!result.settled || kind != 0) continue;
    CHECK(result.without_contact == 0);
    // In contact all along, the mean force is that of the mean chip: to the square of the step.
    const ForceParts force = cut.depth * force_cycle(cut.cutter, kLoad, cut.depth).mean();
    INFO("cut " << n);
    CHECK((result.mean_force_n - force).norm() < 5e-3 * force.norm());
  }
  CHECK(far > 90);
  CHECK(agree >= 0.99 * far);
}

TEST_CASE("a slot with four teeth does not vibrate, and that is settled") {
  const TipStructure structure = tip_structure(fixtures::oscillator({"x", "y"}));
  Cutter cutter = fixtures::benchmark_cutter(true, 1, 4);
  cutter.diameter_m = 10e-3;
  const CuttingLoad chips{0.1e-3, 0, 0, 0, {}};  // edges that enter and leave would turn the force
  const SimulationResult result = simulate_cut(structure, cutter, chips, {100, 0.02e-3, {}, {}, false});
  CHECK(result.stable());
  CHECK(result.settled);
  CHECK(result.keeps_contact);
  // What is left of the push.
  CHECK(result.peak_vibration_m < 1e-6 * result.mean_deflection_m.norm());
}

TEST_CASE("a motion on which a tooth would lose its chip is none of the cut") {
  // A pitch of 69 degrees has a fifth of the feed as its chip, and at a millimetre more vibration than that.
  Cutter cutter = fixtures::benchmark_cutter(false, 0.3, 2);
  cutter.diameter_m = 12e-3;
  cutter.pitch_rad = {1.2, kTwoPi - 1.2};
  const TipStructure structure = tip_structure(fixtures::oscillator({"x", "y"}));
  const CuttingLoad chips{0.1e-3, 0, 0, 0, {}};
  const auto keeps = [&](double speed, double depth) {
    return simulate_cut(structure, cutter, chips, {speed, depth, 64, {}, false}).keeps_contact;
  };
  CHECK(keeps(90, 1e-6));
  CHECK_FALSE(keeps(90, 1e-3));
}

TEST_CASE("where teeth differ the simulation leaves what the periodic solution says") {
  const TipStructure structure = tip_structure(fixtures::coupled_modes(4, 8));
  for (const bool runout : {false, true}) {
    Cutter cutter = fixtures::benchmark_cutter(false, 0.3, 3);
    cutter.diameter_m = 12e-3;
    CuttingLoad load{0.1e-3, 0, 0, 0, {}};
    if (runout)
      load.runout_m = {4e-6, -3e-6, -1e-6};
    else
      cutter.pitch_rad = {2, 2.2, kTwoPi - 4.2};
    constexpr double kDepth = 0.02e-3;
    const SurfacePoint surface = SurfaceAtSpeed(structure, cutter, load, 90, 30).at(kDepth);
    const SimulationResult result = simulate_cut(structure, cutter, load, {90, kDepth, {}, 1600, false});
    REQUIRE(result.settled);
    INFO((runout ? "runout" : "unequal pitch"));
    // Vibration is small beside the chip, and there are no edge forces, which would jump where it ends
    // contact.
    const double tolerance = 1e-3 * (surface.peak_vibration_m + surface.mean_deflection_m.norm());
    CHECK(std::abs(*result.location_error_m - *surface.location_error_m) < tolerance);
    CHECK(std::abs(result.peak_vibration_m - surface.peak_vibration_m) < tolerance);
    CHECK((result.mean_deflection_m - surface.mean_deflection_m).norm() < tolerance);
  }
}

TEST_CASE("15 modes: what the simulation leaves is what the forced vibration says") {
  for (const auto& [up, immersion, speed] :
       {std::tuple{true, 0.25, 75.0}, std::tuple{false, 0.4, 160.0}, std::tuple{false, 0.1, 110.0}}) {
    const TipStructure structure = tip_structure(fixtures::coupled_modes(15, 8));
    Cutter cutter = fixtures::benchmark_cutter(up, immersion, 2);
    cutter.diameter_m = 12e-3;
    constexpr double kDepth = 0.05e-3;
    const SurfacePoint surface = SurfaceAtSpeed(structure, cutter, kLoad, speed, 0).at(kDepth);
    const SimulationResult result = simulate_cut(structure, cutter, kLoad, {speed, kDepth, {}, 800, false});
    REQUIRE(result.settled);
    // The force is linear over each step: the motion is right to (2 pi / 8)^2 / 12 of the 100 steps per wave.
    const double scale = surface.peak_vibration_m + surface.mean_deflection_m.norm();
    CHECK(std::abs(*result.location_error_m - *surface.location_error_m) < 1e-3 * scale);
    CHECK(std::abs(*result.location_error_m / *surface.location_error_m - 1) < 1e-3);
    // The peak between samples, by a parabola.
    CHECK(std::abs(result.peak_vibration_m / surface.peak_vibration_m - 1) < 3e-3);
    CHECK((result.mean_deflection_m - surface.mean_deflection_m).norm() <
          1e-3 * surface.mean_deflection_m.norm());
  }
}

TEST_CASE("a flip doubles the period of the samples") {
  // The benchmark's slot beside a lobe of flips: a real multiplier below -1.
  const TipStructure structure = tip_structure(fixtures::oscillator({"y"}));
  Cutter cutter = fixtures::benchmark_cutter(true, 0.1, 1);
  cutter.diameter_m = 10e-3;
  bool found = false;
  for (double speed = 300; speed < 800 && !found; speed += 20) {
    const auto limits = crossings_at(structure, cutter, speed, 6e-3, 24);
    if (limits.empty() || limits[0].kind != Instability::kFlip) continue;
    found = true;
    // While it grows, before teeth leave the cut: then the two points wander.
    const double depth = 1.01 * limits[0].depth_m;
    const SimulationResult result = simulate_cut(structure, cutter, kLoad, {speed, depth, 64, {}, false});
    CHECK(result.growth.multiplier.real() < -1);
    CHECK(std::abs(result.growth.multiplier.imag()) < 1e-9);
    CHECK(!result.settled);
    REQUIRE(result.samples_m.size() > 40);
    const std::size_t last = result.samples_m.size() - 1;
    for (std::size_t i = last - 20; i < last; ++i) {
      const auto y = [&](std::size_t k) { return result.samples_m[k].y(); };
      CHECK((y(i) - y(i - 1)) * (y(i - 1) - y(i - 2)) < 0);
      CHECK(std::abs(y(i) - y(i - 1)) > 1e-8);
      CHECK(std::abs(y(i) - y(i - 2)) < 0.2 * std::abs(y(i) - y(i - 1)));
    }
    // An odd multiple of half the tooth frequency.
    const double halves = *result.chatter_frequency_hz / (speed / 2);
    CHECK(std::abs(halves - std::round(halves)) < 1e-3);
    CHECK(std::lround(halves) % 2 == 1);
  }
  CHECK(found);
}

TEST_CASE("it chatters at the frequency of the limit") {
  const TipStructure structure = tip_structure(fixtures::oscillator({"x", "y"}));
  Cutter cutter = fixtures::benchmark_cutter(false, 0.5, 3);
  cutter.diameter_m = 10e-3;
  int hopf = 0;
  for (const double speed : {65.0, 90.0, 118.0, 128.0}) {
    const auto limits = crossings_at(structure, cutter, speed, 6e-3, 24);
    if (limits.empty() || limits[0].kind != Instability::kHopf) continue;
    ++hopf;
    // While it grows, before teeth leave the cut: that shifts the frequency. A push that is soon above the
    // other modes' ringing.
    const SimulationResult result =
        simulate_cut(structure, cutter, kLoad, {speed, 1.01 * limits[0].depth_m, 192, {}, false, 0.01});
    REQUIRE(result.chatter_frequency_hz);
    CHECK(std::abs(*result.chatter_frequency_hz / limits[0].chatter_frequency_hz - 1) < 2e-3);
    CHECK(result.without_contact < 0.01);
  }
  CHECK(hopf > 1);
}

TEST_CASE("a stiff tool with runout and unequal pitches cuts the chips of the mean force") {
  dynamics::ModalModel model = fixtures::oscillator({"x", "y"});
  for (dynamics::Mode& mode : model.modes) mode.psi_l *= 1e-4;
  const TipStructure stiff = tip_structure(model);
  for (const bool unequal : {false, true}) {
    for (const double lag : {0.0, 80.0}) {
      Cutter cutter = fixtures::benchmark_cutter(false, 0.6, 3);
      cutter.diameter_m = 10e-3;
      cutter.lag_rad_per_m = lag;
      if (unequal) cutter.pitch_rad = {1.9, 2.2, kTwoPi - 4.1};
      CuttingLoad load = kLoad;
      load.runout_m = {60e-6, -80e-6, 20e-6};  // the second tooth cuts nothing
      const double depth = 1e-3;
      const ForceParts force = depth * force_cycle(cutter, load, depth).mean();
      const SimulationResult result = simulate_cut(stiff, cutter, load, {100, depth, 24, {}, false});
      CHECK((result.mean_force_n - force).norm() < 2e-3 * force.norm());
    }
  }
}

namespace {

// The mean force of a rigid tool whose teeth move on cycloids, from their geometry alone: on the ray from the
// axis through a tooth the path of the tooth before it is looked for.
ForceParts cycloid_force(const Cutter& cutter, double feed_m, double depth_m) {
  constexpr int kTurns = 4000;
  const double radius = cutter.diameter_m / 2, per_rad = feed_m * cutter.teeth / kTwoPi;
  ForceParts sum = ForceParts::Zero();
  for (int i = 0; i < kTurns; ++i) {
    const double phi = cutter.entry_rad + (cutter.exit_rad - cutter.entry_rad) * (i + 0.5) / kTurns;
    const double s = std::sin(phi), c = std::cos(phi);
    // The tooth before passed the ray at phi + turn a pitch earlier, give or take: x to the side of the ray
    // is 0.
    double turn = 0, away = 0;
    for (int step = 0; step < 20; ++step) {
      const double x = per_rad * (turn - cutter.mean_pitch_rad()) + radius * std::sin(phi + turn);
      const double y = radius * std::cos(phi + turn);
      turn -= (x * c - y * s) / radius;
      away = x * s + y * c;
    }
    const double chip = std::max(radius - away, 0.0);
    const double along = cutter.kt_n_per_m2 * chip, across = cutter.kr_n_per_m2 * chip;
    sum += ForceParts(-c * along - s * across, s * along - c * across, 0, along);
  }
  return sum * depth_m * (cutter.exit_rad - cutter.entry_rad) / kTurns / cutter.mean_pitch_rad();
}

}  // namespace

TEST_CASE("teeth on cycloids cut the chips of cycloids") {
  dynamics::ModalModel model = fixtures::oscillator({"x", "y"});
  for (dynamics::Mode& mode : model.modes) mode.psi_l *= 1e-5;
  const TipStructure stiff = tip_structure(model);
  CuttingLoad load;
  load.feed_per_tooth_m = 0.2e-3;
  for (const bool up : {true, false}) {
    Cutter cutter = fixtures::benchmark_cutter(up, 0.4, 3);
    cutter.diameter_m = 8e-3;
    SimulationRequest request{100, 1e-3, 48, 400, false};
    const ForceParts circles = simulate_cut(stiff, cutter, load, request).mean_force_n;
    request.path = ToothPath::kCycloid;
    const ForceParts cycloids = simulate_cut(stiff, cutter, load, request).mean_force_n;
    const ForceParts expected = cycloid_force(cutter, load.feed_per_tooth_m, 1e-3);
    INFO(circles.transpose() << "; " << cycloids.transpose() << "; " << expected.transpose());
    CHECK((circles - expected).norm() > 5e-3 * expected.norm());
    CHECK((cycloids - expected).norm() < 0.1 * (circles - expected).norm());
  }
}

TEST_CASE("helices that differ: simulated deviations grow as the spectral radius says") {
  const TipStructure structure = tip_structure(fixtures::coupled_modes(5, 3));
  int stable = 0;
  for (const double immersion : {0.2, 1.0}) {
    Cutter cutter = fixtures::benchmark_cutter(true, immersion, 4);
    cutter.pitch_rad = {1.4, 1.65, 1.5, kTwoPi - 4.55};
    cutter.tooth_lag_rad_per_m = {96, 121, 90, 130};
    for (const double depth : {0.15e-3, 2e-3}) {
      const double radius = spectral_radius(SpectralMap(structure, cutter, 120, 16), depth);
      const SimulatedGrowth growth = simulated_growth(structure, cutter, kLoad, 120, depth);
      INFO(immersion << ", " << depth << " m: " << growth.per_tooth << ", " << radius);
      CHECK(std::abs(growth.per_tooth / radius - 1) < 1e-3);
      stable += radius < 1;
    }
  }
  CHECK(stable == 2);
}
