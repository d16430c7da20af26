#include "milling/turning_force.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "base/units.h"
#include "milling/milling_fixtures_test.h"
#include "milling/structure.h"
#include "milling/surface.h"
#include "numerics/random.h"

using namespace stablecut;
using namespace stablecut::milling;

namespace {

constexpr int kSlices = 400;
const CuttingLoad kLoad{0.1e-3, 20e3, 30e3, 5e3, {}};

Cutter random_cutter(std::mt19937_64& generator, bool helical) {
  Cutter cutter = fixtures::benchmark_cutter(true, 1, 1 + static_cast<int>(generator() % 5));
  cutter.ka_n_per_m2 = 150e6;
  if (generator() % 2) cutter.lead_rad = numerics::uniform(generator, 0.5, 1.5);
  if (generator() % 2) cutter.corner_radius_m = 0.5e-3;
  const int walls = static_cast<int>(generator() % 4);
  if (walls & 1) cutter.entry_rad = numerics::uniform(generator, 0.1, 1.4);
  if (walls & 2) cutter.exit_rad = numerics::uniform(generator, 1.6, 3.0);
  if (helical) cutter.lag_rad_per_m = numerics::uniform(generator, -1, 1) > 0 ? 250 : -90;
  return cutter;
}

// Straight slices of an edge one above the other, each of teeth written out.
Eigen::Vector3d sliced_force(const Cutter& cutter, const CuttingLoad& load, double depth, double turn) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  // Of an upright edge with the coefficients of the inclined one.
  const EdgeMeans edge = edge_means(cutter, depth);
  const double kr = cutter.kr_n_per_m2 * edge.sine - cutter.ka_n_per_m2 * edge.cosine;
  const double ka = cutter.kr_n_per_m2 * edge.cosine + cutter.ka_n_per_m2 * edge.sine;
  const int slices = cutter.lag_rad_per_m == 0 ? 1 : kSlices;
  for (int k = 0; k < slices; ++k) {
    for (int j = 0; j < cutter.teeth; ++j) {
      const double lag = cutter.lag_rad_per_m * depth * (k + 0.5) / slices + kTwoPi * j / cutter.teeth;
      const double phi = turn - lag - kTwoPi * std::floor((turn - lag) / kTwoPi);
      if (phi < cutter.entry_rad || phi > cutter.exit_rad) continue;
      const double chip = load.feed_per_tooth_m * std::sin(phi);
      const double along = cutter.kt_n_per_m2 * chip + load.kte_n_per_m * edge.inverse_sine;
      const double across = kr * chip + load.kre_n_per_m - load.kae_n_per_m * edge.cotangent;
      sum += depth / slices *
             Eigen::Vector3d(-std::cos(phi) * along - std::sin(phi) * across,
                             std::sin(phi) * along - std::cos(phi) * across,
                             ka * chip + load.kae_n_per_m + load.kre_n_per_m * edge.cotangent);
    }
  }
  return sum;
}

}  // namespace

TEST_CASE("force over a period: largest along any direction, and mean, as of teeth written out") {
  std::mt19937_64 generator(11);
  for (int n = 0; n < 40; ++n) {
    const Cutter cutter = random_cutter(generator, n % 2 == 1);
    const double depth = numerics::uniform(generator, 0.5e-3, 6e-3);
    const TurningForce force = turning_force(cutter, kLoad, depth);
    INFO("case " << n << ", " << cutter.teeth << " teeth from " << cutter.entry_rad << " to "
                 << cutter.exit_rad << ", lag " << cutter.lag_rad_per_m * depth);
    constexpr int kTurns = 2000;
    Eigen::Matrix3Xd dense(3, kTurns);
    for (int i = 0; i < kTurns; ++i)
      dense.col(i) = sliced_force(cutter, kLoad, depth, kTwoPi / cutter.teeth * (i + 0.5) / kTurns);
    const double size = dense.colwise().norm().maxCoeff();
    // Midpoints beside a jump, and slices that come into cut one by one, are off by a two-thousandth.
    CHECK((force.mean_n - dense.rowwise().mean()).norm() < 2e-3 * size);
    for (int d = 0; d < 30; ++d) {
      Eigen::Vector3d direction;
      for (double& value : direction) value = numerics::unit_normal(generator);
      direction.normalize();
      const double largest = (direction.transpose() * dense).maxCoeff(),
                   found = (direction.transpose() * force.turning_n).maxCoeff();
      // The steps of a turn are off by 1.6e-4 of the second harmonic, slices by a four-hundredth of a tooth.
      CHECK(found >= largest - 3e-3 * size);
      CHECK(found <= largest + 3e-3 * size);
    }
  }
}

TEST_CASE("force at the walls: of the tooth that touches them, with what the others cut meanwhile") {
  std::mt19937_64 generator(12);
  int walls = 0;
  for (int n = 0; n < 40; ++n) {
    const bool helical = n % 2 == 1;
    const Cutter cutter = random_cutter(generator, helical);
    const double depth = numerics::uniform(generator, 0.5e-3, 6e-3);
    const TurningForce force = turning_force(cutter, kLoad, depth);
    const double period = kTwoPi / cutter.teeth;
    REQUIRE(force.walls.size() == wall_angles(cutter).size());
    for (const TurningForce::Wall& wall : force.walls) {
      ++walls;
      REQUIRE(wall.leaving_n.cols() > 0);
      CHECK((wall.leaving_n.cols() > 1) == helical);
      const double inside = wall.angle_rad == 0 ? 1e-7 : -1e-7;
      const double size = force.turning_n.colwise().norm().maxCoeff();
      // An edge that lags by more than a period sees all of it in one.
      const double along = std::clamp(cutter.lag_rad_per_m * depth, -period, period);
      const int last = static_cast<int>(wall.leaving_n.cols()) - 1;
      INFO("case " << n << ", wall " << wall.angle_rad);
      for (int k = 0; k <= last; ++k) {
        const double lag = helical ? along * k / last : 0;
        const Eigen::Vector3d plain = sliced_force(cutter, kLoad, depth, wall.angle_rad + lag + inside);
        CHECK((wall.leaving_n.col(k) - plain).norm() < (helical ? 1e-2 : 1e-6) * size);
      }
    }
  }
  CHECK(walls > 10);
}

TEST_CASE("at a crawl the tip follows the force: the walls of a forced vibration are those of the force") {
  // 922 Hz against a tooth each 250 s: what swings after a jump has died away long before the wall.
  const TipStructure structure = tip_structure(fixtures::coupled_modes(4, 5));
  Eigen::Matrix2d compliance = Eigen::Matrix2d::Zero();
  for (Eigen::Index k = 0; k < structure.modes(); ++k)
    compliance +=
        2 * (structure.psi_r.col(k) * structure.psi_l.col(k).transpose() / -structure.lambda[k]).real();
  CuttingLoad load = kLoad;
  load.kte_n_per_m = load.kre_n_per_m = load.kae_n_per_m = 0;  // a jump at the wall itself swings there
  int compared = 0;
  for (const bool up : {true, false}) {
    for (const double lag : {0.0, 150.0}) {
      for (const double immersion : {0.3, 0.8}) {
        Cutter cutter = fixtures::benchmark_cutter(up, immersion, 4);
        cutter.lag_rad_per_m = lag;
        const double depth = 3e-3;
        const SurfacePoint point = SurfaceAtSpeed(structure, cutter, load, 1e-3, 8).at(depth);
        const TurningForce force = turning_force(cutter, load, depth);
        CHECK((point.mean_deflection_m - compliance * force.mean_n.head<2>()).norm() <
              1e-9 * point.mean_deflection_m.norm());
        REQUIRE(force.walls.size() == 1);
        const Eigen::RowVectorXd normal =
            (compliance * force.walls[0].leaving_n.topRows(2)).row(1) * (up ? -1 : 1);
        Eigen::Index at = 0;
        normal.cwiseAbs().maxCoeff(&at);
        REQUIRE(point.location_error_m);
        // Both take the edge in steps: of a degree here, of an eighth there.
        const double size = point.mean_deflection_m.norm();
        CHECK(std::abs(normal[at] - *point.location_error_m) < 1e-3 * size);
        if (std::abs(normal[at]) > 1e-2 * size) ++compared;
      }
    }
  }
  CHECK(compared >= 4);
}

TEST_CASE("where teeth differ, none is known to leave the wall") {
  Cutter cutter = fixtures::benchmark_cutter(false, 0.5, 2);
  CuttingLoad load = kLoad;
  load.runout_m = {5e-6, -5e-6};
  TurningForce force = turning_force(cutter, load, 1e-3);
  REQUIRE(force.walls.size() == 1);
  CHECK(force.walls[0].leaving_n.cols() == 0);
  load.runout_m.clear();
  cutter.pitch_rad = {3, kTwoPi - 3};
  force = turning_force(cutter, load, 1e-3);
  REQUIRE(force.walls.size() == 1);
  CHECK(force.walls[0].leaving_n.cols() == 0);
}
