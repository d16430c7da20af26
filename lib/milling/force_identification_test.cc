#include "milling/force_identification.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "base/units.h"
#include "milling/cutting_force.h"
#include "milling/milling_fixtures_test.h"
#include "numerics/random.h"

using namespace stablecut;
using namespace stablecut::milling;

namespace {

const Eigen::Matrix<double, kCoefficients, 1> kTruth =
    (Eigen::Matrix<double, kCoefficients, 1>() << 700e6, 250e6, 20e3, 30e3, 150e6, 4e3).finished();

CuttingLoad load_of(double feed_m) { return {feed_m, kTruth[2], kTruth[3], kTruth[5], {}}; }

MeasuredForce measured(Cutter cutter, double feed_m, double depth_m) {
  cutter.kt_n_per_m2 = kTruth[0];
  cutter.kr_n_per_m2 = kTruth[1];
  cutter.ka_n_per_m2 = kTruth[4];
  const ForceParts force = depth_m * force_cycle(cutter, load_of(feed_m), depth_m).mean();
  return {cutter, {}, feed_m, depth_m, {force.x(), force.y(), force.z()}, {}};
}

// Twenty slots: five feeds, two depths, twice each.
std::vector<MeasuredForce> slots() {
  const Cutter cutter = fixtures::benchmark_cutter(true, 1, 2);
  std::vector<MeasuredForce> forces;
  for (int i = 0; i < 20; ++i)
    forces.push_back(measured(cutter, (0.03 + 0.02 * (i % 5)) * 1e-3, i % 10 < 5 ? 1e-3 : 2e-3));
  return forces;
}

}  // namespace

TEST_CASE("exact mean forces give the coefficients back, in any engagement") {
  std::mt19937_64 generator(2);
  for (const bool slot : {true, false}) {
    std::vector<MeasuredForce> forces = slots();
    for (int i = 0; !slot && i < 20; ++i) {
      Cutter cutter = fixtures::benchmark_cutter(i % 2 == 0, numerics::uniform(generator, 0.1, 0.9), 3);
      if (i % 3 == 0) cutter.pitch_rad = {1.8, 2.2, kTwoPi - 4.0};
      forces[i] = measured(cutter, numerics::uniform(generator, 0.02, 0.2) * 1e-3, 2e-3);
    }
    const ForceIdentification found = identify_coefficients(forces);
    for (int c = 0; c < kCoefficients; ++c) {
      CHECK(found.verdict[c] == CoefficientVerdict::kIdentified);
      CHECK(found.value[c] == Approx(kTruth[c]).epsilon(1e-9));
    }
    CHECK(!found.residual[0].not_linear);
  }
}

TEST_CASE("95 % intervals of coefficients from 20 noisy slots hold 93 to 97 %") {
  constexpr int kTrials = 2000;
  std::array<int, kCoefficients> inside{};
  int bent = 0, uneven = 0;
  const std::vector<MeasuredForce> exact = slots();
  for (int seed = 1; seed <= kTrials; ++seed) {
    std::mt19937_64 generator(static_cast<unsigned>(seed));
    std::vector<MeasuredForce> noisy = exact;
    for (MeasuredForce& one : noisy) {
      for (int axis = 0; axis < 3; ++axis)
        *one.force_n[axis] += (axis < 2 ? 2.0 : 0.7) * numerics::unit_normal(generator);
    }
    const ForceIdentification found = identify_coefficients(noisy);
    for (int c = 0; c < kCoefficients; ++c)
      inside[c] += std::abs(found.value[c] - kTruth[c]) <= found.half_interval_95[c];
    bent += found.residual[0].not_linear;
    uneven += found.residual[0].uneven;
  }
  for (int c = 0; c < kCoefficients; ++c) {
    INFO("coefficient " << c << ": " << inside[c] << " of " << kTrials);
    CHECK(inside[c] > 0.93 * kTrials);
    CHECK(inside[c] < 0.97 * kTrials);
  }
  // One in a hundred by chance: within four deviations.
  CHECK(bent < kTrials * 0.01 + 4 * std::sqrt(kTrials * 0.01));
  CHECK(uneven < kTrials * 0.01 + 4 * std::sqrt(kTrials * 0.01));
}

TEST_CASE("stated deviations weigh, hold, and are contradicted where they are too small") {
  std::vector<MeasuredForce> exact = slots();
  constexpr int kTrials = 600;
  int inside = 0, contradicted = 0;
  for (int seed = 1; seed <= kTrials; ++seed) {
    std::mt19937_64 generator(static_cast<unsigned>(seed));
    std::vector<MeasuredForce> noisy = exact;
    for (std::size_t i = 0; i < noisy.size(); ++i) {
      for (int axis = 0; axis < 3; ++axis) {
        const double deviation = i % 2 == 0 ? 1 : 10;
        *noisy[i].force_n[axis] += deviation * numerics::unit_normal(generator);
        noisy[i].std_n[axis] = deviation;
      }
    }
    const ForceIdentification found = identify_coefficients(noisy);
    inside += std::abs(found.value[0] - kTruth[0]) <= found.half_interval_95[0];
    contradicted += found.residual[0].deviations_contradicted;
    for (MeasuredForce& one : noisy) {
      for (auto& deviation : one.std_n) deviation = 0.1;
    }
    CHECK(identify_coefficients(noisy).residual[0].deviations_contradicted);
  }
  CHECK(inside > 0.93 * kTrials);
  CHECK(inside < 0.97 * kTrials);
  CHECK(contradicted < 0.03 * kTrials);
}

TEST_CASE("what the cuts cannot tell is said") {
  std::vector<MeasuredForce> one_feed = slots();
  for (MeasuredForce& one : one_feed) one = measured(one.cutter, 0.05e-3, one.depth_m);
  ForceIdentification found = identify_coefficients(one_feed);
  for (const CoefficientVerdict verdict : found.verdict) CHECK(verdict == CoefficientVerdict::kInseparable);
  // With the edges given, the others are there.
  found = identify_coefficients(one_feed, {{{}, {}, kTruth[2], kTruth[3], {}, kTruth[5]}});
  for (const Coefficient c : {Coefficient::kKt, Coefficient::kKr, Coefficient::kKa}) {
    CHECK(found.identified(c));
    CHECK(found.of(c) == Approx(kTruth[static_cast<int>(c)]).epsilon(1e-9));
  }
  CHECK(found.verdict[2] == CoefficientVerdict::kHeld);
  // No axial force.
  std::vector<MeasuredForce> plane = slots();
  for (MeasuredForce& one : plane) one.force_n[2].reset();
  found = identify_coefficients(plane);
  CHECK(found.verdict[4] == CoefficientVerdict::kUnmeasured);
  CHECK(found.identified(Coefficient::kKt));
  // Along the feed alone a slot shows the radial coefficients only.
  for (MeasuredForce& one : plane) one.force_n[1].reset();
  found = identify_coefficients(plane);
  CHECK(found.verdict[0] == CoefficientVerdict::kInseparable);
  CHECK(found.of(Coefficient::kKr) == Approx(kTruth[1]).epsilon(1e-9));
  // Two cuts for four coefficients: no deviations.
  plane = slots();
  plane.resize(2);
  found = identify_coefficients(plane);
  CHECK(found.identified(Coefficient::kKt));
  CHECK(!found.deviations_known[0]);
}

TEST_CASE("a size effect is seen, and scatter that differs between the axes") {
  std::mt19937_64 generator(5);
  std::vector<MeasuredForce> forces = slots();
  for (MeasuredForce& one : forces) {
    for (int axis = 0; axis < 3; ++axis)
      *one.force_n[axis] *=
          std::pow(one.feed_per_tooth_m / 0.05e-3, -0.3) * (1 + 1e-3 * numerics::unit_normal(generator));
  }
  CHECK(identify_coefficients(forces).residual[0].not_linear);
  forces = slots();
  for (MeasuredForce& one : forces) {
    *one.force_n[0] += 10 * numerics::unit_normal(generator);
    *one.force_n[1] += 0.5 * numerics::unit_normal(generator);
  }
  CHECK(identify_coefficients(forces).residual[0].uneven);
}
