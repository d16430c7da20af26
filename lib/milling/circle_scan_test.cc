#include "milling/circle_scan.h"

#include <Eigen/Eigenvalues>
#include <catch2/catch.hpp>
#include <random>

#include "base/range.h"
#include "base/units.h"
#include "milling/circle_lanes.h"
#include "milling/circle_reduction.h"
#include "milling/cut_schedule.h"
#include "milling/depth_scan.h"
#include "milling/limits.h"
#include "milling/milling_fixtures_test.h"
#include "milling/spectral.h"
#include "milling/tooth_arcs.h"

using namespace stablecut;
using namespace stablecut::milling;

namespace {

struct Cut {
  TipStructure structure;
  Cutter cutter;
  double revolutions_per_s = 0, largest_depth_m = 0;
  int points = 0;

  Collocation collocation() const {
    return collocate(structure, cut_schedule(cutter, revolutions_per_s, 0), revolutions_per_s, points);
  }
  double period_s() const {
    return cut_schedule(cutter, revolutions_per_s, 0).period_rad / (kTwoPi * revolutions_per_s);
  }
};

Cut random_cut(unsigned seed) {
  std::mt19937_64 generator(seed);
  const auto uniform = [&](double from, double to) {
    return from + (to - from) * static_cast<double>(generator() >> 11) * 0x1p-53;
  };
  const int modes = 1 + static_cast<int>(uniform(0, 20)), teeth = 1 + static_cast<int>(uniform(0, 8));
  Cut cut{tip_structure(fixtures::coupled_modes(modes, 100 + seed)),
          fixtures::benchmark_cutter(uniform(0, 1) < 0.5, uniform(0.02, 1), teeth)};
  cut.cutter.feed_angle_rad = uniform(0, 3);
  cut.revolutions_per_s = uniform(60, 400);
  cut.largest_depth_m = uniform(1e-3, 6e-3);
  cut.points = point_plan(cut.structure, cut.cutter, cut.revolutions_per_s, cut.largest_depth_m).first + 4;
  return cut;
}

}  // namespace

// The same collocation, but another way through it: the circle knows no depth scan and no period map.
TEST_CASE(
    "passages of the unit circle are the boundaries of a depth scan, and count what a dense solver counts") {
  int boundaries = 0, counted = 0;
  for (unsigned seed = 0; seed < 40; ++seed) {
    const Cut cut = random_cut(seed);
    INFO("seed " << seed);
    const CirclePassages passages = circle_passages(
        period_force(cut.structure, cut.collocation(), cut.period_s()).whole, cut.largest_depth_m);
    CHECK(passages.confirmed);
    const SpectralMap map(cut.structure, cut.cutter, cut.revolutions_per_s, cut.points);
    const auto scanned = DepthScan(map, cut.largest_depth_m).boundaries();
    const auto found = boundaries_among(passages.found);
    REQUIRE(found.size() == scanned.size());
    for (std::size_t i = 0; i < found.size(); ++i, ++boundaries) {
      CHECK(std::abs(found[i]->depth_m - scanned[i].depth_m) < 1e-7 * cut.largest_depth_m);
      CHECK(found[i]->outwards == scanned[i].unstable_above);
    }
    for (const double depth : Range{0.1, 1, 10}.values()) {
      const double a = depth * cut.largest_depth_m;
      const Eigen::VectorXd moduli =
          Eigen::EigenSolver<Eigen::MatrixXd>(map.monodromy(a), false).eigenvalues().cwiseAbs();
      // Above a map that has nearly a pole nothing is certain, and neither next to the circle.
      if (moduli.maxCoeff() > 1e8 || ((moduli.array() - 1).abs() < 1e-6).any()) continue;
      int outside = 0;
      for (const CirclePassage& passage : passages.found)
        outside += passage.depth_m < a ? passage.change() : 0;
      CHECK(outside == (moduli.array() > 1).count());
      ++counted;
    }
  }
  CHECK(boundaries >= 25);
  CHECK(counted >= 300);
}

// A wall of 1e5 N/m with a damping ratio of 0.001 chatters below a thousandth of the depths that are asked
// for.
TEST_CASE("a limit far below the largest depth is found") {
  dynamics::ModalModel model = fixtures::oscillator({"x"});
  dynamics::Mode& mode = model.modes[0];
  mode.frequency_hz = 500;
  mode.damping_ratio = 0.001;
  const double mass = 1e5 / std::pow(kTwoPi * 500, 2);
  mode.psi_l = mode.psi_r / std::complex<double>(0, 2 * mass * mode.pole().imag());
  Cutter cutter = fixtures::benchmark_cutter(false, 1, 4);
  cutter.kt_n_per_m2 = 2000e6;
  for (const double rpm : {9428.0, 9714.0, 10000.0}) {
    const TipStructure structure = tip_structure(model);
    const auto limits = circle_limits(structure, cutter, rpm / 60, 20e-3);
    REQUIRE(limits);
    REQUIRE(!limits->crossings.empty());
    const double depth = limits->crossings.front().depth_m;
    CHECK(depth < 20e-6);
    const SpectralMap map(structure, cutter, rpm / 60, 30);
    CHECK(std::abs(spectral_radius(map, depth) - 1) < 1e-7);
    CHECK(spectral_radius(map, 0.999 * depth) < 1);
    CHECK(spectral_radius(map, 1.001 * depth) > 1);
  }
}

TEST_CASE("fewer polynomials than nodes have the limits of many, also beside a mode far above the band") {
  dynamics::ModalModel model = fixtures::oscillator({"x", "y"});
  dynamics::Mode stand_in = model.modes[0];
  stand_in.frequency_hz = 9000;
  stand_in.damping_ratio = 0.06;
  stand_in.psi_l *= 0.01;
  model.modes.push_back(stand_in);
  const TipStructure structure = tip_structure(model);
  const Cutter cutter = fixtures::benchmark_cutter(true, 0.25);
  int limits = 0, without_ringing = 0;
  for (const double speed : Range{60, 300, 9}.values()) {
    const auto few = circle_limits(structure, cutter, speed, 6e-3);
    REQUIRE(few);
    if (speed < 100) {
      // Below the radians of the stand-in in half a piece no polynomials can follow it.
      CHECK(few->resolution < half_turn_of(kTwoPi * 9000, cut_schedule(cutter, speed, 0), speed));
      ++without_ringing;
    }
    const auto many = crossings_at(structure, cutter, speed, 6e-3, 2 * few->resolution + 40);
    REQUIRE(few->crossings.size() == many.size());
    for (std::size_t i = 0; i < many.size(); ++i, ++limits) {
      CHECK(few->crossings[i].depth_m == Approx(many[i].depth_m).epsilon(1e-3));
      CHECK(few->crossings[i].kind == many[i].kind);
    }
  }
  CHECK(limits >= 6);
  CHECK(without_ringing >= 2);
}

// Pieces and a map of the revolution know nothing of arcs and of what is felt over several periods. The last
// one has arcs longer than its period, 70 and 50 degrees three times.
TEST_CASE("limits of unequal pitches, from polynomials along each tooth's arc, are those of the period map",
          "[campaign]") {
  dynamics::ModalModel model = fixtures::oscillator({"x", "y"});
  dynamics::Mode slow = model.modes[0];
  slow.frequency_hz = 410;
  slow.psi_l *= 922.0 / 410;
  model.modes.push_back(slow);
  // In the other one forces change the velocity at once, and with it what the flanks of all teeth feel.
  dynamics::ModalModel massless = model;
  for (dynamics::Mode& mode : massless.modes) mode.psi_l *= std::polar(1.0, 0.2);
  const TipStructure with_mass = tip_structure(model), without = tip_structure(massless);
  int limits = 0;
  for (const auto& [immersion, degrees, damping] : {std::tuple{0.2, std::vector<double>{170, 190}, 0.0},
                                                    {1.0, {110, 120, 130}, 0.0},
                                                    {0.2, {170, 190}, 5e4},
                                                    {1.0, {150, 210}, 5e4},
                                                    {0.6, {70, 50, 70, 50, 70, 50}, 0.0}}) {
    Cutter cutter = fixtures::benchmark_cutter(true, immersion, static_cast<int>(degrees.size()));
    for (const double angle : degrees) cutter.pitch_rad.push_back(radians_from_degrees(angle));
    cutter.diameter_m = 12e-3;
    cutter.damping_n_per_m = damping;
    cutter.damping_friction = 0.3;

    const TipStructure& structure = damping > 0 && immersion == 1 ? without : with_mass;
    for (const double speed : {90.0, 210.0}) {
      INFO(degrees.size() << " teeth, " << immersion << ", " << speed << " rev/s");
      const auto arcs = circle_limits(structure, cutter, speed, 4e-3);
      REQUIRE(arcs);
      const PreparedPeriod period = prepare_period(structure, cutter, speed, {}, 4e-3);
      const auto scanned =
          scanned_crossings(DepthScan(*period.map, 4e-3), *period.map, cutter.tooth_period_s(speed));
      REQUIRE(arcs->crossings.size() == scanned.size());
      for (std::size_t i = 0; i < scanned.size(); ++i, ++limits) {
        // Multipliers are right to 3e-7.
        CHECK(std::abs(arcs->crossings[i].depth_m - scanned[i].depth_m) < 1e-6 * 4e-3);
        CHECK(arcs->crossings[i].kind == scanned[i].kind);
        CHECK(arcs->crossings[i].chatter_frequency_hz ==
              Approx(scanned[i].chatter_frequency_hz).epsilon(1e-5));
      }
    }
  }
  CHECK(limits >= 8);
}

TEST_CASE(
    "eigenvalues of an operator between its leading vectors are its own, to the square of what is left out") {
  const TipStructure structure = tip_structure(fixtures::coupled_modes(6, 3));
  Cutter cutter = fixtures::benchmark_cutter(true, 1, 3);
  for (const double angle : {100.0, 120.0, 140.0}) cutter.pitch_rad.push_back(radians_from_degrees(angle));
  const CircleOperator whole = tooth_arc_force(structure, tooth_arcs(cutter, 200), 200, 14).whole;
  const double least = 1 / 0.2e-3;
  const auto largest = [](const CircleOperator& of, double angle) {
    const Eigen::MatrixXcd one = Eigen::MatrixXcd::Identity(of.size(), of.size());
    const Eigen::VectorXcd all =
        Eigen::ComplexEigenSolver<Eigen::MatrixXcd>(of.times(angle, one), false).eigenvalues();
    Eigen::Index at = 0;
    all.cwiseAbs().maxCoeff(&at);
    return all[at];
  };
  for (const double share : {1.0, 0.3}) {
    const Eigen::MatrixXd basis = leading_basis(whole, share * least);
    CHECK(basis.cols() < whole.size());
    const CircleOperator few = projected(whole, basis);
    for (const double angle : {0.3, 1.0, 2.0, 3.0})
      CHECK(std::abs(largest(few, angle) - largest(whole, angle)) < share * share * least);
  }
  // The adjoint, and the operator in lanes.
  CircleLanes lanes(whole);
  lanes.form({0.3, 0.3, 0.3, 0.3, 1.0, 1.0, 2.0, 3.0});
  const std::complex<double> value = largest(whole, 2.0);
  const EigenvalueLanes refined = lanes.refined({value, value, value, value, value, value, value, value});
  CHECK(std::abs(refined.value[6] - value) < 1e-9 * std::abs(value));
  const Eigen::VectorXcd right = lanes.right(6), left = lanes.left(6);
  CHECK((whole.times(2.0, right) - value * right).norm() < 1e-8 * std::abs(value) * right.norm());
  CHECK((whole.adjoint_times(2.0, left) - std::conj(value) * left).norm() <
        1e-8 * std::abs(value) * left.norm());
  const double step = 1e-5;
  const std::complex<double> slope = (largest(whole, 2.0 + step) - largest(whole, 2.0 - step)) / (2 * step);
  CHECK(std::abs(refined.slope[6] - slope) < 1e-6 * std::abs(slope));
}

// Limits depend continuously on the speed, and two vanish together only where they meet: at the speed at
// which their number changes, found by bisection, they are as close as the bisection leaves.
TEST_CASE("two limits that vanish between two speeds have met") {
  int met = 0;
  for (unsigned seed = 0; seed < 16; ++seed) {
    const TipStructure structure =
        tip_structure(fixtures::coupled_modes(1 + static_cast<int>(seed % 5), seed));
    const Cutter cutter =
        fixtures::benchmark_cutter(seed % 2 == 0, seed % 3 == 0 ? 0.05 : 0.3, 1 + static_cast<int>(seed % 4));
    const double top = 4e-3;
    const auto crossings = [&](double speed) {
      const auto limits = circle_limits(structure, cutter, speed, top);
      return limits ? std::optional(limits->crossings) : std::nullopt;
    };
    const std::vector<double> speeds = Range{90, 230, 61}.values();
    for (std::size_t i = 0; i + 1 < speeds.size(); ++i) {
      double with = speeds[i], without = speeds[i + 1];
      auto found = crossings(with), fewer = crossings(without);
      REQUIRE(found);
      REQUIRE(fewer);
      if (found->size() < fewer->size()) {
        std::swap(with, without);
        std::swap(found, fewer);
      }
      if (found->size() != fewer->size() + 2) continue;
      bool by_two = true;
      while (by_two && std::abs(with - without) > 1e-12 * with) {
        const double middle = (with + without) / 2;
        const auto there = crossings(middle);
        if (!there) break;  // so near to meeting that rounding leaves it open
        by_two = there->size() == found->size() || there->size() == fewer->size();
        if (there->size() == found->size()) {
          with = middle;
          found = there;
        } else {
          without = middle;
        }
      }
      if (!by_two) continue;
      double nearest = top;
      for (std::size_t k = 0; k + 1 < found->size(); ++k)
        nearest = std::min(nearest, (*found)[k + 1].depth_m - (*found)[k].depth_m);
      INFO("seed " << seed << ", " << with << " rev/s");
      // The distance is as the square root of the speed's.
      CHECK(nearest < 1e-4 * top);
      ++met;
    }
  }
  CHECK(met >= 7);
}
