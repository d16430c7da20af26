#include "milling/spectral.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <tuple>
#include <vector>

#include "base/units.h"
#include "milling/cut_schedule.h"
#include "milling/milling_fixtures_test.h"
#include "milling/semi_discretization.h"
#include "numerics/legendre.h"

using namespace stablecut;
using namespace stablecut::milling;

TEST_CASE("without a cut the multipliers are those of free flight") {
  const TipStructure structure = tip_structure(fixtures::coupled_modes(6, 3));
  for (const int teeth : {1, 2, 3}) {
    const Cutter cutter = fixtures::benchmark_cutter(true, 0.4, teeth);
    const SpectralMap map(structure, cutter, 120, 8);
    const double slowest = structure.lambda.real().maxCoeff();
    CHECK(spectral_radius(map, 0) == Approx(std::exp(slowest * cutter.tooth_period_s(120))).epsilon(1e-12));
  }
}

// What a method of order q gains from 15 to 18 points is (18/15)^q, a factor of 20 for order 16. A kink of
// the force inside a piece leaves an order of 2 or less.
TEST_CASE(
    "three points more gain a factor of 20 at least, and no smaller one later: exponential convergence") {
  const TipStructure structure = tip_structure(fixtures::coupled_modes(6, 3));
  for (const auto& [teeth, immersion] : {std::pair{2, 0.25}, std::pair{3, 1.0}, std::pair{5, 0.6}}) {
    const Cutter cutter = fixtures::benchmark_cutter(false, immersion, teeth);
    const auto radius = [&](int points) {
      return spectral_radius(SpectralMap(structure, cutter, 60, points), 1e-3);
    };
    const double converged = radius(40);
    double before = std::abs(radius(9) - converged);
    CHECK(before > 1e-8);
    for (const int points : {12, 15, 18}) {
      const double error = std::abs(radius(points) - converged);
      INFO(teeth << " teeth, " << points << " points: " << before << ", " << error);
      CHECK(error < std::max(before / 20, 1e-12));
      before = error;
    }
    CHECK(std::abs(radius(24) - converged) < 1e-12);
  }
}

TEST_CASE("semi-discretization tends to the spectral result, with the square of the interval") {
  const TipStructure structure = tip_structure(fixtures::coupled_modes(4, 11));
  for (const auto& [teeth, immersion] : {std::pair{2, 0.25}, std::pair{3, 1.0}, std::pair{4, 0.9}}) {
    Cutter cutter = fixtures::benchmark_cutter(true, immersion, teeth);
    cutter.feed_angle_rad = 0.5;
    const double exact = spectral_radius(SpectralMap(structure, cutter, 200, 30), 0.8e-3);
    const double error_80 =
        std::abs(spectral_radius(SemiDiscretizationMap(structure, cutter, 200, 80), 0.8e-3) - exact);
    const double error_320 =
        std::abs(spectral_radius(SemiDiscretizationMap(structure, cutter, 200, 320), 0.8e-3) - exact);
    INFO(teeth << " teeth: " << error_80 << ", " << error_320);
    CHECK(error_320 < error_80 / 4);
    CHECK(error_320 < 1e-4);
  }
}

TEST_CASE("unequal pitch with equal pitches is the plain case") {
  const TipStructure structure = tip_structure(fixtures::coupled_modes(5, 4));
  for (const auto& [teeth, immersion] : {std::pair{1, 0.3}, std::pair{2, 0.25}, std::pair{3, 0.2},
                                         std::pair{2, 1.0}, std::pair{3, 1.0}, std::pair{4, 0.7}}) {
    Cutter cutter = fixtures::benchmark_cutter(true, immersion, teeth);
    for (const double depth : {0.3e-3, 1.5e-3}) {
      cutter.pitch_rad.clear();
      const double plain = spectral_radius(SpectralMap(structure, cutter, 150, 32), depth);
      cutter.pitch_rad.assign(teeth, kTwoPi / teeth);
      const double by_tooth = spectral_radius(SpectralMap(structure, cutter, 150, 32), depth);
      INFO(teeth << " teeth, immersion " << immersion << ", depth " << depth);
      CHECK(by_tooth == Approx(plain).epsilon(1e-10));
    }
  }
}

TEST_CASE("helix: a slight one is the plain case, and pitches by tooth are the plain pitch") {
  const TipStructure structure = tip_structure(fixtures::coupled_modes(4, 6));
  for (const auto& [teeth, immersion] : {std::pair{3, 0.3}, std::pair{4, 0.8}}) {
    Cutter cutter = fixtures::benchmark_cutter(true, immersion, teeth);
    const double plain = spectral_radius(SpectralMap(structure, cutter, 130, 24), 2e-3);
    cutter.lag_rad_per_m = 1e-9;
    CHECK(spectral_radius(SpectralMap(structure, cutter, 130, 24), 2e-3) == Approx(plain).epsilon(1e-9));
    for (const double lag_at_depth : {0.2, 0.9, -0.5}) {
      cutter.lag_rad_per_m = lag_at_depth / 2e-3;
      cutter.pitch_rad.clear();
      const double helical = spectral_radius(SpectralMap(structure, cutter, 130, 30), 2e-3);
      cutter.pitch_rad.assign(teeth, kTwoPi / teeth);
      CHECK(spectral_radius(SpectralMap(structure, cutter, 130, 30), 2e-3) == Approx(helical).epsilon(1e-9));
    }
  }
}

TEST_CASE("helix: discs of straight teeth, each behind the one below, tend to it", "[campaign]") {
  const TipStructure structure = tip_structure(fixtures::coupled_modes(4, 6));
  const double depth = 2e-3, pitch = kTwoPi / 3;
  const numerics::GaussRule discs = numerics::gauss_legendre(30);
  for (const double lag_at_depth : {0.2, 1.3, -0.5}) {
    Cutter cutter = fixtures::benchmark_cutter(true, 0.3, 3);
    const auto lag = [&](Eigen::Index i) { return lag_at_depth * (1 + discs.node[i]) / 2; };
    std::vector<double> ends;
    const auto add_end = [&](double angle) { ends.push_back(angle - pitch * std::floor(angle / pitch)); };
    for (Eigen::Index i = 0; i < discs.node.size(); ++i) {
      add_end(cutter.entry_rad + lag(i));
      add_end(cutter.exit_rad + lag(i));
    }
    std::sort(ends.begin(), ends.end());
    ends.push_back(ends.front() + pitch);
    CutSchedule schedule{pitch, 1, {}};
    for (std::size_t e = 0; e + 1 < ends.size(); ++e) {
      const double middle = (ends[e] + ends[e + 1]) / 2, start = ends.front();
      // Coefficients of what is in cut in the middle of the piece, that is all along it.
      const auto cutting = [&, middle, start](double turn) {
        Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
        for (Eigen::Index i = 0; i < discs.node.size(); ++i) {
          for (int tooth = -3; tooth <= 3; ++tooth) {
            const double shift = tooth * pitch - lag(i);
            if (!(middle + shift > cutter.entry_rad && middle + shift < cutter.exit_rad)) continue;
            const double s = std::sin(start + turn + shift), c = std::cos(start + turn + shift);
            const Eigen::Vector2d force(-c * cutter.kt_n_per_m2 - s * cutter.kr_n_per_m2,
                                        s * cutter.kt_n_per_m2 - c * cutter.kr_n_per_m2);
            sum.topLeftCorner<2, 2>() += discs.weight[i] / 2 * force * Eigen::RowVector2d(s, c);
          }
        }
        return DirectionalFactors{sum, Eigen::Matrix3d::Identity()};
      };
      if (cutting(middle - start).drive.isZero(0) || ends[e + 1] - ends[e] < 1e-9) continue;
      schedule.pieces.push_back(
          {ends[e] - start, ends[e + 1] - start, cutting, {}, schedule.pieces.size(), true});
    }
    const double sliced = spectral_radius(SpectralMap(structure, schedule, 130, 16), depth);
    cutter.lag_rad_per_m = lag_at_depth / depth;
    const double helical = spectral_radius(SpectralMap(structure, cutter, 130, 30), depth);
    INFO("lag " << lag_at_depth << ": " << helical << ", sliced " << sliced);
    CHECK(sliced == Approx(helical).epsilon(1e-6));
    cutter.lag_rad_per_m = 0;
    CHECK(std::abs(spectral_radius(SpectralMap(structure, cutter, 130, 30), depth) - helical) > 1e-3);
  }
}

TEST_CASE("unequal pitch: it converges, and to the growth of a plain simulation") {
  const TipStructure structure = tip_structure(fixtures::oscillator({"x", "y"}));
  for (const double immersion : {0.1, 1.0}) {
    Cutter cutter = fixtures::benchmark_cutter(true, immersion, 4);
    cutter.pitch_rad = {kTwoPi * 70 / 360, kTwoPi * 110 / 360, kTwoPi * 70 / 360, kTwoPi * 110 / 360};
    const SpectralMap map(structure, cutter, 100, 16);
    const double fine = spectral_radius(SpectralMap(structure, cutter, 100, 26), 0.4e-3);
    CHECK(spectral_radius(map, 0.4e-3) == Approx(fine).epsilon(1e-7));

    // One revolution after the other in small steps (second order), the growth of the motion.
    constexpr int kSteps = 7200;  // in a revolution: pitches are whole numbers of steps
    const double dt = 1.0 / (100.0 * kSteps), depth = 0.4e-3;
    const Eigen::MatrixXd flight = structure.free_flight(dt), half = structure.free_flight(dt / 2),
                          rate = structure.state_rate_of_force(),
                          displacement = structure.displacement_of_state();
    std::vector<Eigen::Vector2d> path;
    Eigen::VectorXd state = Eigen::VectorXd::Ones(2 * structure.modes());
    std::vector<double> size;
    for (int step = 0; step < 60 * kSteps; ++step) {
      const Eigen::VectorXd middle = half * state;
      path.push_back(displacement * middle);
      Eigen::Vector2d force(0, 0);
      double behind = 0;
      for (std::size_t j = 0; j < 4; ++j) {
        // Tooth j follows tooth j - 1 by the pitch before it.
        const double pitch = cutter.pitch_rad[(j + 3) % 4];
        const double phi = std::remainder(kTwoPi * (step + 0.5) / kSteps - behind, kTwoPi);
        behind += cutter.pitch_rad[j];
        if (!(phi > cutter.entry_rad && phi < cutter.exit_rad)) continue;
        const std::size_t delay = std::lround(pitch / kTwoPi * kSteps);
        const Eigen::Vector2d before =
            path.size() > delay ? path[path.size() - 1 - delay] : Eigen::Vector2d(0, 0);
        const double s = std::sin(phi), c = std::cos(phi);
        force += depth *
                 Eigen::Vector2d(-c * cutter.kt_n_per_m2 - s * cutter.kr_n_per_m2,
                                 s * cutter.kt_n_per_m2 - c * cutter.kr_n_per_m2) *
                 (Eigen::RowVector2d(s, c) * (path.back() - before)).value();
      }
      state = flight * state + half * (rate * force) * dt;
      if ((step + 1) % kSteps == 0) size.push_back(state.norm());
    }
    // Growth over the last revolutions, for one tooth.
    const double growth = std::pow(size[59] / size[29], 1.0 / (30 * 4));
    INFO("immersion " << immersion << ": " << fine << ", simulated " << growth);
    CHECK(growth == Approx(fine).epsilon(3e-3));
  }
}

TEST_CASE("process damping converges, and it raises the limit at low speed") {
  const TipStructure structure = tip_structure(fixtures::oscillator({"x", "y"}));
  Cutter cutter = fixtures::benchmark_cutter(true, 0.5, 2);
  const double plain = spectral_radius(SpectralMap(structure, cutter, 20, 60), 0.5e-3);
  cutter.diameter_m = 0.012;
  cutter.damping_n_per_m = 2e5;
  cutter.damping_friction = 0.3;
  const double damped = spectral_radius(SpectralMap(structure, cutter, 20, 60), 0.5e-3);
  CHECK(damped < plain - 0.01);
  CHECK(spectral_radius(SpectralMap(structure, cutter, 20, 72), 0.5e-3) == Approx(damped).epsilon(1e-8));
}

// Four teeth in a slot: two are in cut, at right angles, and their damping is the same in every direction.
TEST_CASE("process damping of four teeth in a slot is viscous damping of the structure") {
  const dynamics::ModalModel model = fixtures::oscillator({"x", "y"});
  Cutter cutter = fixtures::benchmark_cutter(true, 1, 4);
  for (const double speed : {15.0, 80.0}) {
    const double depth = 0.2e-3;
    cutter.diameter_m = 0.02;
    cutter.damping_n_per_m = 2e5;
    const TipStructure structure = tip_structure(model);
    const double damped = spectral_radius(SpectralMap(structure, cutter, speed, 90), depth);
    dynamics::ModalModel viscous = model;
    for (dynamics::Mode& mode : viscous.modes) {
      // c / (2 m w) more, with the mass of the fixture; the residue keeps the mass.
      mode.damping_ratio += depth * 2e5 / (kPi * 0.02 * speed) / (2 * 0.03993 * kTwoPi * 922);
      mode.psi_l = mode.psi_r / std::complex<double>(0, 2 * 0.03993 * mode.pole().imag());
    }
    cutter.damping_n_per_m = 0;
    const TipStructure stiffer = tip_structure(viscous);
    CHECK(spectral_radius(SpectralMap(stiffer, cutter, speed, 90), depth) == Approx(damped).epsilon(1e-9));
    CHECK(spectral_radius(SpectralMap(structure, cutter, speed, 90), depth) > damped + 0.01);
  }
}

// The same with modes as they are measured, whose velocities jump with the force: f = -c r' with
// r' = V q + D f closes a loop q' = L q + B f that does not change with time, but for a hardly cutting
// cutter.
TEST_CASE("process damping of measured modes includes the velocity that a force causes at once") {
  const TipStructure structure = tip_structure(fixtures::coupled_modes(3, 9));
  Cutter cutter = fixtures::benchmark_cutter(true, 1, 4);
  cutter.kt_n_per_m2 = 1;
  cutter.kr_n_per_m2 = 0;
  cutter.diameter_m = 0.02;
  cutter.damping_n_per_m = 2e5;
  const double depth = 0.5e-3, speed = 40, c = depth * 2e5 / (kPi * 0.02 * speed);
  const Eigen::Index n = structure.modes();
  const Eigen::MatrixXcd velocity = structure.psi_r * structure.lambda.asDiagonal();
  Eigen::MatrixXd v(2, 2 * n), l = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  v << 2 * velocity.real(), -2 * velocity.imag();
  for (Eigen::Index k = 0; k < n; ++k) {
    l(k, k) = l(n + k, n + k) = structure.lambda[k].real();
    l(n + k, k) = structure.lambda[k].imag();
    l(k, n + k) = -structure.lambda[k].imag();
  }
  const Eigen::Matrix2d d = 2 * (structure.psi_r * structure.psi_l.transpose()).real();
  const Eigen::Matrix2d loop = Eigen::Matrix2d::Identity() + c * d;
  const Eigen::MatrixXd closed = l - c * structure.state_rate_of_force() * loop.inverse() * v;
  const double growth = Eigen::EigenSolver<Eigen::MatrixXd>(closed, false).eigenvalues().real().maxCoeff();
  const double radius = spectral_radius(SpectralMap(structure, cutter, speed, 40), depth);
  CHECK(radius == Approx(std::exp(growth * cutter.tooth_period_s(speed))).epsilon(1e-9));
  CHECK(c * d.norm() > 0.01);
}

// Pitches of 70 and 110 degrees and a cut that starts at 90: lengths of pieces that should be equal differ by
// rounding, and a piece is linked to the one that cut its surface node by node.
TEST_CASE("unequal pitch: pieces whose lengths differ by rounding have as many points") {
  const TipStructure structure = tip_structure(fixtures::coupled_modes(4, 6));
  Cutter cutter = fixtures::benchmark_cutter(false, 0.5, 4);
  for (const auto& [entry, exit, degrees] : {std::tuple{90.0, 180.0, std::vector<double>{70, 110, 70, 110}},
                                             std::tuple{60.0, 150.0, std::vector<double>{80, 70, 80, 130}},
                                             std::tuple{30.0, 120.0, std::vector<double>{70, 75, 75, 140}}}) {
    cutter.entry_rad = radians_from_degrees(entry);
    cutter.exit_rad = radians_from_degrees(exit);
    cutter.pitch_rad.clear();
    for (const double angle : degrees) cutter.pitch_rad.push_back(radians_from_degrees(angle));
    const double converged = spectral_radius(SpectralMap(structure, cutter, 200, 26), 1e-3);
    // Any number of points that rounding could make one more of on one of the pieces.
    for (int points = 7; points <= 18; ++points) {
      const Collocation collocation = collocate(structure, cut_schedule(cutter, 200, 1e-3), 200, points);
      for (const SensedRow& row : collocation.rows) REQUIRE(row.cut_by >= 0);
      INFO(points << " points");
      CHECK(spectral_radius(SpectralMap(structure, cutter, 200, points), 1e-3) ==
            Approx(converged).epsilon(1e-9));
    }
  }
}
