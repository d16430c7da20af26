#include "robot/force_cone.h"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>

#include "base/units.h"
#include "numerics/random.h"

using namespace stablecut;
using namespace stablecut::robot;

namespace {

Eigen::Vector3d random_vector(std::mt19937_64& generator) {
  return {numerics::unit_normal(generator), numerics::unit_normal(generator),
          numerics::unit_normal(generator)};
}

// Compliances of all shapes: round, flat and long, with axes anywhere, in m/N.
Eigen::Matrix3d random_compliance(std::mt19937_64& generator) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d v = random_vector(generator);
    sum += std::pow(10, numerics::uniform(generator, -9, -6)) * v * v.transpose();
  }
  return sum;
}

}  // namespace

TEST_CASE("the largest deflection over a cone against 1e5 directions in it") {
  std::mt19937_64 generator(31);
  for (int run = 0; run < 30; ++run) {
    const Eigen::Matrix3d compliance = random_compliance(generator);
    const Eigen::Vector3d force = 600 * random_vector(generator);
    const double angle = numerics::uniform(generator, 0.01, 0.5 * kPi);
    const LargestDeflection found = largest_over_cone(compliance, force, angle);
    CHECK(std::abs((compliance * found.force_n).norm() / found.length - 1) < 1e-12);
    CHECK(std::abs(found.force_n.norm() / force.norm() - 1) < 1e-12);
    CHECK(found.force_n.dot(force) >= std::cos(angle) * force.squaredNorm() * (1 - 1e-12));
    // 1e5 directions: a third all over the cone, a third near the best of those, a third on its edge.
    const Eigen::Vector3d axis = force.normalized(), p = axis.unitOrthogonal(), q = axis.cross(p);
    double largest = 0;
    Eigen::Vector2d best(0, 0);
    const auto look = [&](double tilt, double turn) {
      const Eigen::Vector3d u =
          std::cos(tilt) * axis + std::sin(tilt) * (std::cos(turn) * p + std::sin(turn) * q);
      const double length = force.norm() * (compliance * u).norm();
      if (length > largest) best = {tilt, turn};
      largest = std::max(largest, length);
    };
    constexpr int kSamples = 33'333;
    const double golden = kPi * (3 - std::sqrt(5.0));
    for (int k = 0; k < kSamples; ++k)
      look(std::acos(1 - (1 - std::cos(angle)) * (k + 0.5) / kSamples), golden * k);
    for (int k = 0; k < kSamples; ++k) look(angle, kTwoPi * k / kSamples);
    // The samples are 0.014 rad apart at most.
    const Eigen::Vector2d first = best;
    const double wide = first[0] > 0 ? 0.02 / std::sin(std::max(first[0], 0.02)) : kPi;
    for (int k = 0; k < kSamples; ++k) {
      const double along = -1 + 2 * (k % 182) / 181.0, across = -1 + 2 * (k / 182) / 183.0;
      look(std::clamp(first[0] + 0.02 * along, 0.0, angle), first[1] + wide * across);
    }
    CHECK(found.length >= largest * (1 - 1e-14));
    CHECK(found.length <= largest * (1 + 1e-6));
  }
}

TEST_CASE("a force that turns: the closed maximum against 1e5 angles") {
  std::mt19937_64 generator(32);
  for (int run = 0; run < 60; ++run) {
    const Eigen::Matrix3d compliance = random_compliance(generator);
    const Eigen::Vector3d axis = random_vector(generator).normalized();
    const Eigen::Vector3d along =
        run % 3 == 0 ? Eigen::Vector3d::Zero().eval() : (300 * random_vector(generator)).eval();
    const double radius = 200;
    const LargestDeflection found = largest_over_turn(compliance, along, axis, radius);
    CHECK(std::abs((compliance * found.force_n).norm() / found.length - 1) < 1e-12);
    const Eigen::Vector3d p = axis.unitOrthogonal(), q = axis.cross(p);
    double largest = 0;
    for (int k = 0; k < 100'000; ++k) {
      const double turn = kTwoPi * k / 100'000;
      largest = std::max(largest,
                         (compliance * (along + radius * (std::cos(turn) * p + std::sin(turn) * q))).norm());
    }
    CHECK(found.length >= largest * (1 - 1e-14));
    CHECK(found.length <= largest * (1 + 1e-8));
  }
}

TEST_CASE("the largest deflection where directions are equally good") {
  const Eigen::Matrix3d round = 1e-6 * Eigen::Matrix3d::Identity();
  CHECK(largest_over_cone(round, {0, 0, -100}, 0.3).length == Approx(1e-4));
  CHECK(largest_over_turn(round, {0, 0, 30}, {0, 0, 1}, 40).length == Approx(5e-5));
  // Across its axis a round compliance has no best angle; one axis softer has two.
  const Eigen::Matrix3d soft_x = Eigen::Vector3d(4e-6, 1e-6, 1e-6).asDiagonal();
  CHECK(largest_over_turn(soft_x, Eigen::Vector3d::Zero(), {0, 0, 1}, 100).length == Approx(4e-4));
  CHECK(largest_over_cone(soft_x, {0, 100, 0}, 0).length == Approx(1e-4));
  // A cone of a right angle holds every line.
  CHECK(largest_over_cone(soft_x, {0, 100, 0}, 0.5 * kPi).length == Approx(4e-4));
}
