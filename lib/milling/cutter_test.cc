#include "milling/cutter.h"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>

#include "base/error.h"
#include "base/units.h"
#include "milling/cut_schedule.h"
#include "milling/milling_fixtures_test.h"
#include "milling/spectral.h"
#include "numerics/legendre.h"
#include "numerics/random.h"

using namespace stablecut;
using namespace stablecut::milling;

namespace {

Cutter cutter_with(int teeth, bool up, double immersion) {
  Cutter cutter;
  cutter.teeth = teeth;
  cutter.kt_n_per_m2 = 6.89e8;
  cutter.kr_n_per_m2 = 2.67e8;
  set_immersion(cutter, up, immersion);
  return cutter;
}

Eigen::Matrix2d coefficients(const DirectionalFactors& factors) {
  return (factors.drive * factors.sense).topLeftCorner<2, 2>();
}

// The coefficients over a period, integrated piece by piece.
Eigen::Matrix2d integrated(const CutSchedule& schedule) {
  const numerics::GaussRule rule = numerics::gauss_legendre(40);
  Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
  for (const CutPiece& piece : schedule.pieces) {
    const double half = (piece.to_rad - piece.from_rad) / 2;
    for (Eigen::Index i = 0; i < rule.node.size(); ++i)
      sum += half * rule.weight[i] * coefficients(piece.cutting(piece.from_rad + half * (1 + rule.node[i])));
  }
  return sum;
}

}  // namespace

TEST_CASE("25 % immersion cuts from 0 to 60 degrees up and from 120 to 180 down") {
  const Cutter up = cutter_with(2, true, 0.25), down = cutter_with(2, false, 0.25);
  CHECK(up.entry_rad == 0);
  CHECK(degrees_from_radians(up.exit_rad) == Approx(60));
  CHECK(degrees_from_radians(down.entry_rad) == Approx(120));
  CHECK(degrees_from_radians(down.exit_rad) == Approx(180));
  Cutter cutter;
  CHECK_THROWS_AS(set_immersion(cutter, true, 0), InvalidArgument);
  CHECK_THROWS_AS(set_immersion(cutter, true, 1.01), InvalidArgument);
}

TEST_CASE("slotting with an even number of teeth is one piece, with an odd number two") {
  CHECK(cut_schedule(cutter_with(2, false, 1), 100, 1e-3).pieces.size() == 1);
  CHECK(cut_schedule(cutter_with(8, true, 1), 100, 1e-3).pieces.size() == 1);
  CHECK(cut_schedule(cutter_with(3, false, 1), 100, 1e-3).pieces.size() == 2);
}

TEST_CASE("the pieces hold all that is cut, whatever the pitch and the helix") {
  for (const int teeth : {1, 2, 3, 4, 5, 8, 12}) {
    for (const double immersion : {0.05, 0.4, 0.77, 1.0}) {
      Cutter cutter = cutter_with(teeth, immersion < 0.5, immersion);
      cutter.feed_angle_rad = 0.7;
      INFO(teeth << " teeth, immersion " << immersion);
      const double pitch = cutter.mean_pitch_rad();
      const Eigen::Matrix2d mean =
          mean_directional_coefficients(cutter, 0, pitch, 1e-3).topLeftCorner<2, 2>();
      // The mean over a pitch is the mean of the means over its parts, teeth entering inside a part or not.
      Eigen::Matrix2d parts = Eigen::Matrix2d::Zero();
      for (int i = 0; i < 7; ++i)
        parts += mean_directional_coefficients(cutter, i * pitch / 7, (i + 1) * pitch / 7, 1e-3)
                     .topLeftCorner<2, 2>() /
                 7;
      CHECK((parts - mean).norm() < 1e-12 * mean.norm());
      for (const double lag : {0.0, 30.0, -90.0, 900.0, 4000.0}) {
        cutter.lag_rad_per_m = lag;
        cutter.pitch_rad.clear();
        CHECK((integrated(cut_schedule(cutter, 100, 3e-3)) - mean * pitch).norm() < 1e-11 * mean.norm());
        for (int j = 0; j < teeth; ++j) cutter.pitch_rad.push_back(pitch * (1 + 0.1 * std::sin(1.7 * j)));
        double sum = 0;
        for (const double angle : cutter.pitch_rad) sum += angle;
        for (double& angle : cutter.pitch_rad) angle *= kTwoPi / sum;
        const CutSchedule schedule = cut_schedule(cutter, 100, 3e-3);
        CHECK(schedule.passes == teeth);
        CHECK((integrated(schedule) - mean * kTwoPi).norm() < 1e-11 * teeth * mean.norm());
        for (const CutPiece& piece : schedule.pieces) {
          const CutPiece& before = schedule.pieces[piece.cut_by];
          CHECK(before.to_rad - before.from_rad == Approx(piece.to_rad - piece.from_rad));
          CHECK((before.from_rad > piece.from_rad || teeth == 1) == piece.in_period_before);
          CHECK(piece.to_rad < kTwoPi + 1e-9);
        }
      }
    }
  }
}

TEST_CASE("a feed angle turns the coefficients as a tensor") {
  Cutter cutter = cutter_with(2, true, 0.5);
  const Eigen::Matrix2d straight = coefficients(cut_schedule(cutter, 100, 1e-3).pieces[0].cutting(0.4));
  cutter.feed_angle_rad = kPi / 2;  // the feed along +y: what was x is y, what was y is -x
  const Eigen::Matrix2d turned = coefficients(cut_schedule(cutter, 100, 1e-3).pieces[0].cutting(0.4));
  CHECK(turned(1, 1) == Approx(straight(0, 0)));
  CHECK(turned(0, 0) == Approx(straight(1, 1)));
  CHECK(turned(0, 1) == Approx(-straight(1, 0)));
}

TEST_CASE("process damping takes energy wherever the tooth is, and more the slower it turns") {
  Cutter cutter = cutter_with(3, true, 0.3);
  CHECK(!cut_schedule(cutter, 100, 1e-3).pieces[0].damping);
  cutter.damping_n_per_m = 6e5;
  cutter.diameter_m = 0.012;
  for (const double turn : {0.0, 0.5, 1.0}) {
    const auto at = [&](double speed) {
      return coefficients(cut_schedule(cutter, speed, 1e-3).pieces[0].damping(turn));
    };
    const Eigen::Matrix2d damping = at(50);
    CHECK((damping - damping.transpose()).norm() < 1e-12 * damping.norm());
    CHECK(damping.trace() == Approx(-6e5 / (kPi * 0.012 * 50)));
    CHECK((at(25) - 2 * damping).norm() < 1e-12 * damping.norm());
  }
}

TEST_CASE(
    "a pattern of pitches that repeats has the period of the pattern, and the radii of the revolution") {
  const TipStructure structure = tip_structure(fixtures::coupled_modes(3, 4));
  Cutter cutter = fixtures::benchmark_cutter(true, 0.6, 4);
  cutter.pitch_rad = {70 * kPi / 180, 110 * kPi / 180, 70 * kPi / 180, 110 * kPi / 180};
  const CutSchedule half = cut_schedule(cutter, 100, 0);
  CHECK(half.period_rad == Approx(kPi));
  CHECK(half.passes == 2);
  // By a millionth of a degree another pattern, of a whole revolution.
  Cutter other = cutter;
  other.pitch_rad[0] += 1e-8;
  other.pitch_rad[1] -= 1e-8;
  CHECK(cut_schedule(other, 100, 0).period_rad == Approx(kTwoPi));
  for (const double depth : {0.2e-3, 1e-3})
    CHECK(spectral_radius(SpectralMap(structure, cutter, 100, 24), depth) ==
          Approx(spectral_radius(SpectralMap(structure, other, 100, 24), depth)).epsilon(1e-6));
}

TEST_CASE("an inclined edge and a corner: chips normal to the edge, written out over the height") {
  std::mt19937_64 generator(3);
  for (int n = 0; n < 12; ++n) {
    Cutter cutter = fixtures::benchmark_cutter(true, 1, 1);
    cutter.ka_n_per_m2 = 150e6;
    cutter.lead_rad = numerics::uniform(generator, 0.3, kPi / 2);
    cutter.corner_radius_m = n < 4 ? 0 : numerics::uniform(generator, 0.2e-3, 3e-3);
    cutter.feed_angle_rad = n % 2 == 0 ? 0 : 0.7;
    const double depth = n == 11 ? 1e-5 : 1e-3, phi = 0.9;
    const Eigen::AngleAxisd feed(cutter.feed_angle_rad, Eigen::Vector3d::UnitZ());
    Eigen::Matrix3d expected = Eigen::Matrix3d::Zero();
    constexpr int kSlices = 20000;
    for (int i = 0; i < kSlices; ++i) {
      // Slices are finer at the tip, where the edge is flat.
      const double share = (i + 0.5) / kSlices, height = depth * share * share, weight = 2 * share / kSlices;
      const double at_corner =
          cutter.corner_radius_m > 0 ? std::acos(std::max(1 - height / cutter.corner_radius_m, -1.0)) : kPi;
      const double kappa = std::min(cutter.lead_rad, at_corner);
      const Eigen::Vector3d along(-std::cos(phi), std::sin(phi), 0);
      const Eigen::Vector3d normal(std::sin(kappa) * std::sin(phi), std::sin(kappa) * std::cos(phi),
                                   -std::cos(kappa));
      const Eigen::Vector3d edge = along.cross(normal) * (along.cross(normal).z() > 0 ? 1 : -1);
      const Eigen::Vector3d force =
          cutter.kt_n_per_m2 * along - cutter.kr_n_per_m2 * normal + cutter.ka_n_per_m2 * edge;
      expected += weight / std::sin(kappa) * force * normal.transpose();
    }
    expected = feed * expected * feed.inverse();
    const DirectionalFactors factors = way_of_tooth(cutter, 100, depth)[0].cutting(phi);
    INFO("case " << n);
    CHECK(factors.sense.rows() == (n < 4 ? 1 : 3));
    CHECK((factors.drive * factors.sense - expected).norm() < 2e-5 * expected.norm());
    // Slices of a lag and the mean over a turn have the same coefficients.
    cutter.feed_angle_rad = 0;
    const Eigen::Matrix3d mean = mean_directional_coefficients(cutter, phi - 1e-4, phi + 1e-4, depth);
    CHECK((feed * mean * feed.inverse() - factors.drive * factors.sense).norm() < 1e-6 * mean.norm());
  }
}

TEST_CASE("in a plane an inclined edge is an upright one of another radial coefficient") {
  const TipStructure structure = tip_structure(fixtures::coupled_modes(3, 4));
  Cutter inclined = fixtures::benchmark_cutter(true, 0.7, 3), upright = inclined;
  inclined.ka_n_per_m2 = 100e6;
  inclined.lead_rad = 0.8;
  upright.kr_n_per_m2 = inclined.kr_n_per_m2 * std::sin(0.8) - inclined.ka_n_per_m2 * std::cos(0.8);
  const double radius = spectral_radius(SpectralMap(structure, upright, 100, 20), 1e-3);
  CHECK(spectral_radius(SpectralMap(structure, inclined, 100, 20), 1e-3) == Approx(radius).epsilon(1e-12));
}
