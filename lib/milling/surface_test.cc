#include "milling/surface.h"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>

#include "base/units.h"
#include "milling/milling_fixtures_test.h"
#include "numerics/random.h"

using namespace stablecut;
using namespace stablecut::milling;

namespace {

using Complex = std::complex<double>;

const CuttingLoad kLoad{0.1e-3, 0, 20e3, 30e3, 0, {}};

// Coefficient of exp(i k turn) in the Fourier series of the force per depth, feed and normal.
Eigen::Vector2cd force_harmonic(const ForceCycle& cycle, int k) {
  Eigen::Vector2cd sum = Eigen::Vector2cd::Zero();
  for (const auto& arc : cycle.arcs) {
    const auto integral = [&](int m) -> Complex {
      if (m == 0) return arc.to_rad - arc.from_rad;
      return (std::polar(1.0, m * arc.to_rad) - std::polar(1.0, m * arc.from_rad)) / Complex(0, m);
    };
    sum += arc.harmonics.col(0).head<2>() * integral(-k);
    for (int m = 1; m < 3; ++m)
      sum += arc.harmonics.col(m).head<2>() * integral(m - k) +
             arc.harmonics.col(m).head<2>().conjugate() * integral(-m - k);
  }
  return sum / cycle.period_rad;
}

}  // namespace

TEST_CASE("forced vibration is the harmonic sum of the receptance, and the surface follows from it") {
  std::mt19937_64 generator(5);
  for (int n = 0; n < 8; ++n) {
    // One mode, one tooth; several of both; a feed at an angle.
    const int teeth = n < 4 ? 1 : n - 2;
    const TipStructure structure =
        n < 4 ? tip_structure(fixtures::oscillator({"y"})) : tip_structure(fixtures::coupled_modes(n - 2, n));
    Cutter cutter = fixtures::benchmark_cutter(n % 2 == 0, n == 3 || n == 6 ? 1 : 0.2, teeth);
    if (n > 5) cutter.feed_angle_rad = 0.7;
    const double speed = numerics::uniform(generator, 20, 200), omega = kTwoPi * speed;
    const ForceCycle cycle = force_cycle(cutter, kLoad);
    const ForcedVibration vibration(structure, cutter, cycle, speed);
    const Eigen::Matrix2d feed = Eigen::Rotation2Dd(cutter.feed_angle_rad).toRotationMatrix();
    const auto moved = [&](Complex s, const Eigen::Vector2cd& force) -> Eigen::Vector2cd {
      const Eigen::Vector2cd own = feed * force;
      const Eigen::VectorXcd motion = structure.mode_receptances(s, own(structure.axes)).rowwise().sum();
      Eigen::Vector2cd whole = Eigen::Vector2cd::Zero();
      whole(structure.axes) = motion;
      return feed.transpose() * whole;
    };
    std::vector<Eigen::Vector2cd> parts;  // of the tip's motion: multiples of the teeth's passing frequency
    for (int k = 0; k < 6000; ++k)
      parts.push_back(moved(Complex(0, k * teeth * omega), force_harmonic(cycle, k * teeth)));
    for (double turn : {0.0, 0.4, 2.0, kPi}) {
      if (n >= 4) turn += 0.1;  // not where an arc ends
      Eigen::Vector2d sum = parts[0].real();
      for (std::size_t k = 1; k < parts.size(); ++k)
        sum += 2 * (parts[k] * std::polar(1.0, static_cast<double>(k) * teeth * turn)).real();
      INFO("case " << n << ", turn " << turn);
      // One mode of a mass: terms like k^-3. Modes that do not belong to a mass: like k^-2.
      CHECK((vibration.displacement(1, turn) - sum).norm() < (n < 4 ? 1e-6 : 5e-4) * sum.norm());
    }
    CHECK((vibration.displacements(2, 40).col(10) - vibration.displacement(2, vibration.period_rad() / 4))
              .norm() < 1e-11 * vibration.displacement(2, 0).norm());
    CHECK((vibration.mean(1) - parts[0].real()).norm() < 1e-12 * vibration.mean(1).norm());
    // Up milling leaves its wall at phi = 0, on the side of +Y; material is left where the tip stays back.
    const double at_wall = vibration.displacement(1e-3, n % 2 == 0 ? 0 : kPi).y();
    if (cutter.exit_rad - cutter.entry_rad < 3)
      CHECK(*surface_of(vibration, cutter, 1e-3, 64).location_error_m == (n % 2 == 0 ? -at_wall : at_wall));
  }
}

TEST_CASE("a helical edge is many straight ones") {
  for (const double lag : {150.0, -90.0}) {
    Cutter cutter = fixtures::benchmark_cutter(false, 0.3, 3);
    const TipStructure structure = tip_structure(fixtures::coupled_modes(4, 2));
    const ForceCycle cycle = force_cycle(cutter, kLoad);
    const ForcedVibration straight(structure, cutter, cycle, 60);
    cutter.lag_rad_per_m = lag;
    const ForcedVibration helical(structure, cutter, cycle, 60);
    constexpr double kDepth = 5e-3;
    constexpr int kEdges = 2000;
    for (const double turn : {-1.0, 0.0, 0.7, 2.5}) {
      Eigen::Vector2d sum = Eigen::Vector2d::Zero();
      for (int i = 0; i < kEdges; ++i)
        sum += straight.displacement(kDepth / kEdges, turn - lag * kDepth * (i + 0.5) / kEdges);
      // The midpoint rule of a motion whose slope has corners.
      CHECK((helical.displacement(kDepth, turn) - sum).norm() < 1e-5 * sum.norm());
      const auto many = helical.displacements(kDepth, 30);
      CHECK((many.col(7) - helical.displacement(kDepth, 7 * helical.period_rad() / 30)).norm() <
            1e-10 * many.col(7).norm());
    }
    // A multiple of the axial pitch: the force does not change, and the tip stands still.
    const double axial_pitch = kTwoPi / 3 / std::abs(lag);
    const SurfacePoint still = surface_of(helical, cutter, axial_pitch, 64);
    CHECK(still.peak_vibration_m < 1e-9 * still.mean_deflection_m.norm());
    CHECK(*still.location_error_m == Approx(still.mean_deflection_m.y()).epsilon(1e-9));
  }
}

TEST_CASE("a plain simulation of coupled modes settles to the forced vibration") {
  const TipStructure structure = tip_structure(fixtures::coupled_modes(15, 8));
  const Cutter cutter = fixtures::benchmark_cutter(false, 0.25, 2);
  constexpr double kSpeed = 75, kDepth = 1e-3;
  const ForceCycle cycle = force_cycle(cutter, kLoad);
  const ForcedVibration vibration(structure, cutter, cycle, kSpeed);
  // Exact steps of each mode under the force at the middle of the step, until what was there at the start is
  // gone.
  constexpr int kSteps = 16000;
  const double step = cycle.period_rad / kSteps, time = step / (kTwoPi * kSpeed);
  const Eigen::VectorXcd growth = (structure.lambda * time).array().exp();
  const int periods =
      static_cast<int>(std::ceil(std::log(1e-6) / (structure.lambda.real().maxCoeff() * kSteps * time)));
  Eigen::VectorXcd q = Eigen::VectorXcd::Zero(structure.modes());
  double largest = 0, error = 0;
  const double scale = vibration.displacements(kDepth, 64).colwise().norm().maxCoeff();
  for (int i = 0; i < periods * kSteps; ++i) {
    const Eigen::Vector2d force = kDepth * sum_at(cycle.arcs, cycle.period_rad, (i + 0.5) * step).head<2>();
    const Eigen::VectorXcd drive = structure.psi_l.transpose() * force(structure.axes);
    q = growth.cwiseProduct(q) +
        (growth.array() - 1).matrix().cwiseProduct(drive).cwiseQuotient(structure.lambda);
    if (i < (periods - 1) * kSteps || i % 400 != 399) continue;
    const Eigen::Vector2d tip = 2 * (structure.psi_r * q).real();
    error = std::max(error, (tip - vibration.displacement(kDepth, (i + 1) * step)).norm());
    largest = std::max(largest, tip.norm());
  }
  CHECK(largest > 0.9 * scale);
  CHECK(error < 1e-3 * scale);
}

TEST_CASE("at a resonance the surface error changes its sign, up and down milling on opposite sides") {
  // A mode along the normal, teeth passing just below and above its frequency: there the tip follows the
  // force's first harmonic, in phase below and against it above.
  const TipStructure structure = tip_structure(fixtures::oscillator({"y"}));
  const double natural = std::abs(structure.lambda[0]) / kTwoPi;
  const auto error = [&](bool up, double share) {
    Cutter cutter = fixtures::benchmark_cutter(up, 0.05, 1);
    cutter.kr_n_per_m2 = 0;
    const ForceCycle cycle = force_cycle(cutter, {0.1e-3, 0, 0, 0, 0, {}});
    return *surface_of(ForcedVibration(structure, cutter, cycle, share * natural), cutter, 1e-3, 64)
                .location_error_m;
  };
  // The tangential force pushes the tip towards +Y: below a resonance into the wall of up milling, away from
  // that of down milling.
  CHECK(error(true, 0.9) < 0);
  CHECK(error(false, 0.9) > 0);
  CHECK(error(true, 1.1) > 0);
  CHECK(error(false, 1.1) < 0);
}
