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

const CuttingLoad kLoad{0.1e-3, 20e3, 30e3, 0, {}};

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

SurfacePoint surface_at(const TipStructure& structure, const Cutter& cutter, const CuttingLoad& load,
                        double revolutions_per_s, double depth_m) {
  return SurfaceAtSpeed(structure, cutter, load, revolutions_per_s, 10).at(depth_m);
}

// A cut stepped through time until what was there at its start is gone: the linear delay equation, each tooth
// of `heights` straight edges cutting where bites() says. The tip's motion over the last period, [2 x steps
// of a revolution] in the cut's frame; pitches are whole numbers of steps.
Eigen::Matrix3Xd stepped(const TipStructure& structure, const Cutter& cutter, const CuttingLoad& load,
                         double speed, double depth_m, int steps, int revolutions, int heights) {
  const double step = kTwoPi / steps;
  const ModesInCut modes = modes_in_cut(structure, cutter, speed);
  const Eigen::VectorXcd growth = (modes.rate * step).array().exp();
  const Eigen::VectorXcd held = (growth.array() - 1) / modes.rate.array();
  // The response to a force that grows by 1 a step.
  const Eigen::VectorXcd rising = (held.array() - step) / (modes.rate.array() * step);
  std::vector<Bite> all = bites(cutter, load);
  if (cutter.equal_pitch() && load.runout_m.empty()) {
    const std::vector<Bite> one = all;
    for (int tooth = 1; tooth < cutter.teeth; ++tooth) {
      for (Bite bite : one) {
        bite.behind_rad += tooth * kTwoPi / cutter.teeth;
        all.push_back(bite);
      }
    }
  }
  Eigen::Matrix3Xd history = Eigen::Matrix3Xd::Zero(3, steps), motion = history;
  Eigen::VectorXcd q = Eigen::VectorXcd::Zero(structure.modes());
  const double flank =
      cutter.damping_n_per_m > 0 ? cutter.damping_n_per_m / (kPi * cutter.diameter_m * speed) : 0;
  const auto force = [&](int i, const Eigen::Vector3d& tip, const Eigen::Vector3d& velocity) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const Bite& bite : all) {
      for (int z = 0; z < heights; ++z) {
        const double lag = cutter.lag_rad_per_m * depth_m * (z + 0.5) / heights;
        const double phi = std::remainder(i * step - bite.behind_rad - lag - kPi, kTwoPi) + kPi;
        if (phi < bite.entry_rad || phi >= bite.exit_rad) continue;
        const Eigen::Vector3d out(std::sin(phi), std::cos(phi), 0), along(-out.y(), out.x(), 0);
        const int before = (i - static_cast<int>(std::lround(bite.delay_rad / step)) + 2 * steps) % steps;
        const double chip = bite.slope_m * out.x() + bite.offset_m + out.dot(tip - history.col(before));
        const double rubbed = flank * out.dot(velocity);
        sum += depth_m / heights *
               (along * (cutter.kt_n_per_m2 * chip + load.kte_n_per_m + cutter.damping_friction * rubbed) -
                out * (cutter.kr_n_per_m2 * chip + load.kre_n_per_m + rubbed));
      }
    }
    return sum;
  };
  const auto tip_of = [&](const Eigen::VectorXcd& state) -> Eigen::Vector3d {
    return 2 * (modes.shape * state).real();
  };
  const auto velocity_of = [&](const Eigen::VectorXcd& state, const Eigen::Vector3d& f) -> Eigen::Vector3d {
    return kTwoPi * speed * 2 *
           (modes.shape * (modes.rate.cwiseProduct(state) + modes.drive.transpose() * f)).real();
  };
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  for (int i = 0; i < revolutions * steps; ++i) {
    const Eigen::Vector3d now = force(i % steps, tip_of(q), velocity);
    history.col(i % steps) = tip_of(q);
    const Eigen::VectorXcd drive = modes.drive.transpose() * now;
    Eigen::VectorXcd next = growth.cwiseProduct(q) + held.cwiseProduct(drive);
    const Eigen::Vector3d then = force((i + 1) % steps, tip_of(next), velocity_of(next, now));
    next += rising.cwiseProduct(modes.drive.transpose() * (then - now));
    velocity = velocity_of(next, then);
    q = next;
    motion.col((i + 1) % steps) = tip_of(q);
  }
  return motion;
}

}  // namespace

TEST_CASE("vibration that changes the chip is what a simulation settles to") {
  const TipStructure structure = tip_structure(fixtures::coupled_modes(3, 4));
  constexpr double kSpeed = 70, kDepth = 0.4e-3;
  constexpr int kSteps = 7200;
  Cutter cutter = fixtures::benchmark_cutter(false, 0.6, 4);
  cutter.feed_angle_rad = 0.4;
  CuttingLoad load = kLoad;
  int heights = 1;
  SECTION("unequal pitch") { cutter.pitch_rad = {1.4, 1.7, 1.5, kTwoPi - 4.6}; }
  SECTION("runout, one tooth cutting what two before it left") {
    load.runout_m = {0, -0.15e-3, 0.02e-3, 0.03e-3};
  }
  SECTION("process damping") {
    cutter.damping_n_per_m = 2e5;
    cutter.damping_friction = 0.3;
    cutter.diameter_m = 0.016;
  }
  SECTION("a helix and unequal pitch") {
    cutter.pitch_rad = {1.4, 1.7, 1.5, kTwoPi - 4.6};
    cutter.lag_rad_per_m = 600;
    heights = 40;
  }
  for (double& pitch : cutter.pitch_rad) pitch = std::round(pitch * kSteps / kTwoPi) * kTwoPi / kSteps;
  // Edges enter and leave in the middle of a step, where half of it is right.
  for (double* angle : {&cutter.entry_rad, &cutter.exit_rad})
    *angle = (std::floor(*angle * kSteps / kTwoPi) - 0.5) * kTwoPi / kSteps;
  const Eigen::Matrix3Xd simulated = stepped(structure, cutter, load, kSpeed, kDepth, kSteps, 30, heights);
  const ForcedVibration forced(structure, cutter, force_cycle(cutter, load, 1e-3), kSpeed);
  std::vector<double> turns;
  for (int i = 0; i < kSteps; i += 45) turns.push_back(i * kTwoPi / kSteps);
  const Eigen::Matrix3Xd still =
      RegenerativeVibration(structure, cutter, load, forced, kSpeed, kDepth, 10, turns).displacements(kDepth);
  const double scale = still.colwise().norm().maxCoeff();
  double error = 0, changed = 0;
  for (Eigen::Index i = 0; i < still.cols(); ++i) {
    error = std::max(error, (still.col(i) - simulated.col(45 * i)).norm());
    changed = std::max(changed, (still.col(i) - forced.displacement(kDepth, turns[i])).norm());
  }
  CHECK(changed > 0.02 * scale);
  CHECK(error < 7e-4 * scale);
}

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
    const ForceCycle cycle = force_cycle(cutter, kLoad, 1e-3);
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
      CHECK((vibration.displacement(1, turn).head<2>() - sum).norm() < (n < 4 ? 1e-6 : 5e-4) * sum.norm());
    }
    CHECK((vibration.displacements(2, 40).col(10) - vibration.displacement(2, vibration.period_rad() / 4))
              .norm() < 1e-11 * vibration.displacement(2, 0).norm());
    CHECK((vibration.mean(1).head<2>() - parts[0].real()).norm() < 1e-12 * vibration.mean(1).norm());
    // Up milling leaves its wall at phi = 0, on the side of +Y; material is left where the tip stays back.
    const double at_wall = vibration.displacement(1e-3, n % 2 == 0 ? 0 : kPi).y();
    if (cutter.exit_rad - cutter.entry_rad < 3)
      CHECK(*surface_at(structure, cutter, kLoad, speed, 1e-3).location_error_m ==
            Approx(n % 2 == 0 ? -at_wall : at_wall).epsilon(1e-12));
  }
}

TEST_CASE("a helical edge is many straight ones") {
  for (const double lag : {150.0, -90.0}) {
    Cutter cutter = fixtures::benchmark_cutter(false, 0.3, 3);
    const TipStructure structure = tip_structure(fixtures::coupled_modes(4, 2));
    const ForceCycle cycle = force_cycle(cutter, kLoad, 1e-3);
    const ForcedVibration straight(structure, cutter, cycle, 60);
    cutter.lag_rad_per_m = lag;
    const ForcedVibration helical(structure, cutter, cycle, 60);
    constexpr double kDepth = 5e-3;
    constexpr int kEdges = 2000;
    for (const double turn : {-1.0, 0.0, 0.7, 2.5}) {
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
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
    const SurfacePoint still = surface_at(structure, cutter, kLoad, 60, axial_pitch);
    CHECK(still.peak_vibration_m < 1e-9 * still.mean_deflection_m.norm());
    CHECK(*still.location_error_m == Approx(still.mean_deflection_m.y()).epsilon(1e-9));
  }
}

TEST_CASE("a plain simulation of coupled modes settles to the forced vibration") {
  const TipStructure structure = tip_structure(fixtures::coupled_modes(15, 8));
  const Cutter cutter = fixtures::benchmark_cutter(false, 0.25, 2);
  constexpr double kSpeed = 75, kDepth = 1e-3;
  const ForceCycle cycle = force_cycle(cutter, kLoad, 1e-3);
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
    error = std::max(error, (tip - vibration.displacement(kDepth, (i + 1) * step).head<2>()).norm());
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
    return *surface_at(structure, cutter, {0.1e-3, 0, 0, 0, {}}, share * natural, 1e-3).location_error_m;
  };
  // The tangential force pushes the tip towards +Y: below a resonance into the wall of up milling, away from
  // that of down milling.
  CHECK(error(true, 0.9) < 0);
  CHECK(error(false, 0.9) > 0);
  CHECK(error(true, 1.1) > 0);
  CHECK(error(false, 1.1) < 0);
}

TEST_CASE("the deepest cut within an error of the surface") {
  const TipStructure structure = tip_structure(fixtures::coupled_modes(4, 2));
  for (const double lag : {0.0, 400.0}) {
    Cutter cutter = fixtures::benchmark_cutter(false, 0.3, 3);
    cutter.lag_rad_per_m = lag;
    SurfaceAtSpeed surface(structure, cutter, kLoad, 60, 10);
    constexpr double kTop = 4e-3;
    const double allowed = 0.6 * std::abs(*surface.at(kTop / 2).location_error_m);
    const double deepest = surface.deepest_within(allowed, kTop);
    REQUIRE((deepest > 0 && deepest < kTop));
    CHECK(std::abs(*surface.at(deepest).location_error_m) <= allowed);
    CHECK(std::abs(*surface.at(deepest + 1e-3 * kTop).location_error_m) > allowed);
    CHECK(surface.deepest_within(1, kTop) == kTop);
  }
}

TEST_CASE("stand-in modes below the band are the static compliance that a pose replaces") {
  dynamics::ModalModel model = fixtures::coupled_modes(3, 6);
  model.modes[0].frequency_hz = 5;
  CHECK(compliance_below_band(model).norm() == 0);
  model.modes[0].out_of_band = true;
  model.modes[2].frequency_hz = 5000;
  model.modes[2].out_of_band = true;
  const Eigen::Matrix2cd part = model.modes[0].residue() / -model.modes[0].pole();
  CHECK((compliance_below_band(model) - 2 * part.real()).norm() < 1e-14 * part.norm());
}
