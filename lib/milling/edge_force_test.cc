#include "milling/edge_force.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "base/error.h"
#include "base/units.h"
#include "milling/milling_fixtures_test.h"
#include "numerics/random.h"

using namespace stablecut;
using namespace stablecut::milling;

namespace {

const CuttingLoad kLoad{0.1e-3, 20e3, 30e3, 5e3, {}};

}  // namespace

TEST_CASE("mean force in any engagement: the integrals of the average force model") {
  // [Altintas2012]: with primitives of sin cos, sin^2, sin and cos between entry and exit.
  std::mt19937_64 generator(4);
  for (int n = 0; n < 40; ++n) {
    Cutter cutter = fixtures::benchmark_cutter(true, 1, 1 + n % 6);
    cutter.entry_rad = n % 4 == 0 ? 0 : numerics::uniform(generator, 0, 1.5);
    cutter.exit_rad = n % 3 == 0 ? kPi : numerics::uniform(generator, 1.6, 3.1);
    cutter.lag_rad_per_m = n % 2 == 0 ? 0 : numerics::uniform(generator, -200, 300);
    cutter.ka_n_per_m2 = 150e6;
    const double depth = numerics::uniform(generator, 0.2e-3, 20e-3), f = kLoad.feed_per_tooth_m;
    const double a = cutter.entry_rad, b = cutter.exit_rad, share = cutter.teeth * depth / kTwoPi;
    const double sc = (std::cos(2 * a) - std::cos(2 * b)) / 4;
    const double ss = (b - a) / 2 - (std::sin(2 * b) - std::sin(2 * a)) / 4;
    const double s = std::cos(a) - std::cos(b), c = std::sin(b) - std::sin(a);
    const double kt = cutter.kt_n_per_m2, kr = cutter.kr_n_per_m2;
    const ForceParts expected =
        share * ForceParts(-f * (kt * sc + kr * ss) - kLoad.kte_n_per_m * c - kLoad.kre_n_per_m * s,
                           f * (kt * ss - kr * sc) + kLoad.kte_n_per_m * s - kLoad.kre_n_per_m * c,
                           f * cutter.ka_n_per_m2 * s + kLoad.kae_n_per_m * (b - a),
                           f * kt * s + kLoad.kte_n_per_m * (b - a));
    const EdgeForce force(cutter, kLoad, depth);
    INFO("case " << n);
    CHECK((force.mean() - expected).norm() < 1e-12 * expected.norm());
    CHECK((force.harmonic(0).real() - expected).norm() < 1e-12 * expected.norm());
  }
}

TEST_CASE("the harmonics sum to the force, and the peak is the largest of it") {
  std::mt19937_64 generator(6);
  for (int n = 0; n < 12; ++n) {
    Cutter cutter = fixtures::benchmark_cutter(n % 2 == 0, numerics::uniform(generator, 0.1, 1), 1 + n % 4);
    cutter.lag_rad_per_m = n % 3 == 0 ? 0 : numerics::uniform(generator, 60, 200);
    if (n % 4 == 3) cutter.pitch_rad = {1.4, 1.7, 1.5, kTwoPi - 4.6};
    CuttingLoad load = kLoad;
    if (n % 4 == 2) load.runout_m = {10e-6, -30e-6, 20e-6};
    const EdgeForce force(cutter, load, 4e-3);
    const double period = force.period_rad();
    double largest = 0;
    for (int i = 0; i < 4000; ++i) {
      const double turn = period * (i + 0.5) / 4000;
      const ForceParts here = force.at(turn);
      largest = std::max(largest, here.head<3>().norm());
      CHECK((here - force.at(turn + 3 * period)).norm() < 1e-9 * here.norm() + 1e-9);
    }
    const EdgeForce::Peak peak = force.peak();
    INFO("case " << n);
    CHECK(peak.force_n >= largest * (1 - 1e-9));
    CHECK(peak.force_n <= largest * 1.01);  // 4000 places; the force rises by less than that between two
    if (n % 3 == 0) continue;
    // A helical edge's force has no jumps: coefficients fall with the square of the order.
    const double turn = 0.37 * period;
    Eigen::Vector4d sum = force.mean();
    for (int k = 1; k <= 2000; ++k)
      sum += 2 * (force.harmonic(k) * std::polar(1.0, k * kTwoPi * turn / period)).real();
    CHECK((sum - force.at(turn)).norm() < 1e-3 * peak.force_n);
  }
}

TEST_CASE("a published simulation's cut: the mean force of either way to turn") {
  // 16 mm, four teeth, helix 45, 1 mm deep and 5 mm wide, 3333 rpm, 40 mm/s: it prints 144 to 156 N and does
  // not say how the tool turns against the feed. Written out with the integrals of the test above.
  Cutter cutter;
  cutter.teeth = 4;
  cutter.kt_n_per_m2 = 1930.4e6;
  cutter.kr_n_per_m2 = 1159.6e6;
  cutter.ka_n_per_m2 = 200.6e6;
  cutter.diameter_m = 16e-3;
  cutter.lag_rad_per_m = 2 / cutter.diameter_m;
  const CuttingLoad load{40e-3 / (3333.0 / 60) / 4, 0, 0, 0, {}};
  set_immersion(cutter, true, 5.0 / 16);
  const ForceParts up = EdgeForce(cutter, load, 1e-3).mean();
  set_immersion(cutter, false, 5.0 / 16);
  const ForceParts down = EdgeForce(cutter, load, 1e-3).mean();
  // Both are mirror images in the chip: as long, 155 N in the plane and 156 N with the axial part, and along
  // the feed and normal to it another pair each.
  CHECK(up.head<2>().norm() == Approx(154.956).epsilon(1e-5));
  CHECK(down.head<2>().norm() == Approx(up.head<2>().norm()).epsilon(1e-12));
  CHECK(up.head<3>().norm() == Approx(155.621).epsilon(1e-5));
  CHECK(up.x() == Approx(-150.793).epsilon(1e-5));
  CHECK(up.y() == Approx(35.677).epsilon(1e-4));
  CHECK(down.x() == Approx(39.326).epsilon(1e-4));
  CHECK(down.y() == Approx(149.883).epsilon(1e-5));
}

TEST_CASE("helices that differ: the sum of many straight teeth, each with the chip of its height") {
  Cutter cutter = fixtures::benchmark_cutter(false, 0.7, 3);
  cutter.pitch_rad = {1.9, 2.2, kTwoPi - 4.1};
  cutter.tooth_lag_rad_per_m = {150, 0, 190};
  const double depth = 5e-3;
  const EdgeForce force(cutter, kLoad, depth);
  CHECK(force.period_rad() == kTwoPi);
  const auto straight_teeth = [&](double turn) {
    ForceParts sum = ForceParts::Zero();
    constexpr int kSlices = 20000;
    for (int i = 0; i < kSlices; ++i) {
      const double height = depth * (i + 0.5) / kSlices;
      double behind = 0;
      for (int j = 0; j < 3; ++j) {
        const int before = (j + 2) % 3;
        const double pitch = cutter.pitch_rad[before] +
                             (cutter.tooth_lag_rad_per_m[j] - cutter.tooth_lag_rad_per_m[before]) * height;
        double phi = turn - behind - cutter.tooth_lag_rad_per_m[j] * height;
        phi -= kTwoPi * std::floor(phi / kTwoPi);
        behind += cutter.pitch_rad[j];
        if (phi < cutter.entry_rad || phi > cutter.exit_rad) continue;
        const double s = std::sin(phi), c = std::cos(phi);
        const double chip = kLoad.feed_per_tooth_m * 3 / kTwoPi * pitch * s;
        const double along = cutter.kt_n_per_m2 * chip + kLoad.kte_n_per_m;
        const double across = cutter.kr_n_per_m2 * chip + kLoad.kre_n_per_m;
        sum += depth / kSlices *
               ForceParts(-c * along - s * across, s * along - c * across, kLoad.kae_n_per_m, along);
      }
    }
    return sum;
  };
  const double size = force.peak().force_n;
  std::vector<Eigen::Matrix<std::complex<double>, 4, 1>> harmonic;
  for (int k = 0; k <= 100; ++k) harmonic.push_back(force.harmonic(k));
  for (const double turn : {0.1, 1.3, 2.6, 3.9, 5.2, -8.0}) {
    INFO(turn);
    ForceParts harmonics = harmonic[0].real();
    CHECK((force.at(turn) - straight_teeth(turn)).norm() < 1e-3 * size);
    for (int k = 1; k <= 100; ++k) harmonics += 2 * (harmonic[k] * std::polar(1.0, k * turn)).real();
    CHECK((harmonics - force.at(turn)).norm() < 2e-2 * size);
  }
  CHECK((harmonic[0].real() - force.mean()).norm() < 1e-12 * size);

  // Alike, they are one helix.
  cutter.pitch_rad.clear();
  cutter.tooth_lag_rad_per_m.clear();
  cutter.lag_rad_per_m = 150;
  const EdgeForce alike(cutter, kLoad, depth);
  cutter.pitch_rad.assign(3, kTwoPi / 3);
  cutter.tooth_lag_rad_per_m.assign(3, 150);
  const EdgeForce listed(cutter, kLoad, depth);
  for (const double turn : {0.1, 1.3, 2.6}) CHECK((alike.at(turn) - listed.at(turn)).norm() < 1e-10 * size);
  CHECK(listed.peak().force_n == Approx(alike.peak().force_n).epsilon(1e-9));

  // The second edge is a third of a turn behind the first at the tip, and the first lags by 200 rad/m more.
  cutter.tooth_lag_rad_per_m = {200, 0, 150};
  const double meet = kTwoPi / 3 / 200;
  CHECK_NOTHROW(EdgeForce(cutter, kLoad, 0.99 * meet));
  CHECK_THROWS_AS(EdgeForce(cutter, kLoad, 1.01 * meet), NoAnswer);
  CuttingLoad runout = kLoad;
  runout.runout_m = {1e-5, -1e-5, 0};
  CHECK_THROWS_AS(EdgeForce(cutter, runout, 0.5 * meet), InvalidArgument);
}
