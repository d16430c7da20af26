#include "milling/cutter.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "base/error.h"
#include "base/units.h"
#include "milling/exponential_moments.h"

using namespace stablecut;

namespace {

Cutter cutter_with(int teeth, bool up, double immersion) {
  Cutter cutter;
  cutter.teeth = teeth;
  cutter.kt_n_per_m2 = 6.89e8;
  cutter.kr_n_per_m2 = 2.67e8;
  set_immersion(cutter, up, immersion);
  return cutter;
}

double engaged_length(const Cutter& cutter) {
  double sum = 0;
  for (const auto& arc : engaged_arcs(cutter))
    sum += (arc.to_rad - arc.from_rad) * (arc.last_tooth - arc.first_tooth);
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

TEST_CASE("the arcs hold all that is cut: teeth times length is exit less entry") {
  for (const int teeth : {1, 2, 3, 4, 5, 8, 12}) {
    for (const double immersion : {0.05, 0.25, 0.5, 0.77, 1.0}) {
      for (const bool up : {true, false}) {
        const Cutter cutter = cutter_with(teeth, up, immersion);
        INFO(teeth << " teeth, immersion " << immersion << (up ? " up" : " down"));
        CHECK(engaged_length(cutter) == Approx(cutter.exit_rad - cutter.entry_rad).epsilon(1e-11));
      }
    }
  }
}

TEST_CASE("slotting with an even number of teeth is one arc, with an odd number two") {
  CHECK(engaged_arcs(cutter_with(2, false, 1)).size() == 1);
  CHECK(engaged_arcs(cutter_with(8, true, 1)).size() == 1);
  const auto arcs = engaged_arcs(cutter_with(3, false, 1));
  REQUIRE(arcs.size() == 2);
  CHECK(arcs[0].last_tooth - arcs[0].first_tooth + arcs[1].last_tooth - arcs[1].first_tooth == 3);
}

TEST_CASE("exact means equal a quadrature of the coefficients over the arcs") {
  const GaussRule rule = gauss_legendre(40);
  for (const int teeth : {1, 2, 3, 5}) {
    for (const double immersion : {0.05, 0.4, 1.0}) {
      Cutter cutter = cutter_with(teeth, false, immersion);
      cutter.feed_angle_rad = 0.7;
      Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
      for (const auto& arc : engaged_arcs(cutter)) {
        const double half = (arc.to_rad - arc.from_rad) / 2;
        for (Eigen::Index i = 0; i < rule.node.size(); ++i) {
          sum += half * rule.weight[i] *
                 directional_coefficients(cutter, arc, arc.from_rad + half * (1 + rule.node[i]));
        }
      }
      const double pitch = cutter.pitch_rad();
      const Eigen::Matrix2d mean = mean_directional_coefficients(cutter, 0, pitch);
      CHECK((mean * pitch - sum).norm() < 1e-12 * sum.norm());
      // The mean over a pitch is the mean of the means over its parts, teeth entering inside a part or not.
      Eigen::Matrix2d parts = Eigen::Matrix2d::Zero();
      for (int i = 0; i < 7; ++i)
        parts += mean_directional_coefficients(cutter, i * pitch / 7, (i + 1) * pitch / 7) / 7;
      CHECK((parts - mean).norm() < 1e-12 * mean.norm());
    }
  }
}

TEST_CASE("a feed angle turns the coefficients as a tensor") {
  Cutter cutter = cutter_with(2, true, 0.5);
  const auto arc = engaged_arcs(cutter).front();
  const Eigen::Matrix2d straight = directional_coefficients(cutter, arc, 0.4);
  cutter.feed_angle_rad = kPi / 2;  // the feed along +y: what was x is y, what was y is -x
  const Eigen::Matrix2d turned = directional_coefficients(cutter, arc, 0.4);
  CHECK(turned(1, 1) == Approx(straight(0, 0)));
  CHECK(turned(0, 0) == Approx(straight(1, 1)));
  CHECK(turned(0, 1) == Approx(-straight(1, 0)));
}

TEST_CASE("the factors of the directional coefficients multiply to them") {
  for (const int teeth : {1, 2, 3, 6}) {
    Cutter cutter = cutter_with(teeth, true, 0.8);
    cutter.feed_angle_rad = 0.3;
    for (const auto& arc : engaged_arcs(cutter)) {
      const double phase = 0.3 * arc.from_rad + 0.7 * arc.to_rad;
      const auto factors = directional_factors(cutter, arc, phase);
      const Eigen::Matrix2d whole = directional_coefficients(cutter, arc, phase);
      CHECK((factors.drive * factors.sense - whole).norm() < 1e-14 * whole.norm());
      CHECK(factors.sense.rows() == std::min(2, arc.last_tooth - arc.first_tooth));
    }
  }
}
