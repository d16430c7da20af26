#include "numerics/constrained_maximum.h"

#include <catch2/catch.hpp>
#include <cmath>

using namespace stablecut;
using namespace stablecut::numerics;

namespace {

Variables variables(std::initializer_list<double> values) {
  Variables v(values.size());
  Eigen::Index i = 0;
  for (const double value : values) v[i++] = value;
  return v;
}

// -|x - target|^2 (1 + x0^2) outside or inside a ball about the origin.
ConstrainedFunction near_target(const Variables& target, double radius, double sense) {
  return [=](const Variables& x) -> std::optional<ConstrainedValue> {
    return ConstrainedValue{-(x - target).squaredNorm(),
                            Eigen::VectorXd::Constant(1, sense * (x.norm() - radius))};
  };
}

}  // namespace

TEST_CASE("an optimum inside") {
  const auto function = [](const Variables& x) -> std::optional<ConstrainedValue> {
    return ConstrainedValue{-std::pow(x[0] - 0.3, 4) - std::pow(x[1] + 0.2 * x[0], 2), Eigen::VectorXd()};
  };
  const auto found =
      constrained_maximum(function, variables({0.9, 0.9}), variables({-1, -1}), variables({1, 1}), 0.1, 1e-4);
  REQUIRE(found);
  CHECK(found->value > -1e-9);
}

TEST_CASE("an optimum on a curved constraint, also along it") {
  // The point of the sphere nearest to the target, from the far side of it.
  const Variables target = variables({0.3, -0.4, 0.5});
  const auto found = constrained_maximum(near_target(target, 1, 1), variables({-0.9, 0.9, 0.1}),
                                         variables({-2, -2, -2}), variables({2, 2, 2}), 0.05, 1e-4);
  REQUIRE(found);
  CHECK((found->point - target.normalized()).norm() < 1e-6);
  CHECK(found->point.norm() >= 1);
}

TEST_CASE("an optimum in a corner of constraint and bound, and from a start that is not allowed") {
  const Variables target = variables({3, 0.2});
  for (const auto& start : {variables({0.1, 0.1}), variables({0.5, 1.9})}) {
    const auto found = constrained_maximum(near_target(target, 1, -1), start, variables({0, 0.5}),
                                           variables({2, 2}), 0.1, 1e-4);
    REQUIRE(found);
    CHECK(found->point[0] == Approx(std::sqrt(0.75)).epsilon(1e-8));
    CHECK(found->point[1] == Approx(0.5).epsilon(1e-8));
    CHECK(found->point.norm() <= 1);
  }
}

TEST_CASE("nothing allowed, nothing found; nothing free, nothing moved") {
  const Variables target = variables({3, 0});
  CHECK_FALSE(constrained_maximum(near_target(target, 1, -1), variables({2, 2}), variables({1.5, 1.5}),
                                  variables({3, 3}), 0.1, 1e-4));
  const auto constant = [](const Variables&) -> std::optional<ConstrainedValue> {
    return ConstrainedValue{7, Eigen::VectorXd::Constant(1, 1.0)};
  };
  CHECK(constrained_maximum(constant, Variables(0), Variables(0), Variables(0), 0.1, 1e-4)->value == 7);
  // Nothing is free, and the one point there is, is not allowed.
  const auto refused = [](const Variables&) -> std::optional<ConstrainedValue> {
    return ConstrainedValue{7, Eigen::VectorXd::Constant(1, -1.0)};
  };
  CHECK_FALSE(constrained_maximum(refused, Variables(0), Variables(0), Variables(0), 0.1, 1e-4));
}

TEST_CASE("along a curved constraint with a bound beside it, in few evaluations") {
  // The most of y on a cylinder of radius 1 about an axis askew to all three variables, x held at its bound
  // 0.2: every step leaves the cylinder, and least steps back on to it have to keep to the bound.
  const Eigen::Vector3d axis = Eigen::Vector3d(0.3, 0.5, 1).normalized();
  int evaluations = 0;
  const auto function = [&](const Variables& x) -> std::optional<ConstrainedValue> {
    ++evaluations;
    const Eigen::Vector3d across = x - axis.dot(x) * axis;
    return ConstrainedValue{x[1] + 2 * x[0] + 0.1 * x[2],
                            Eigen::VectorXd::Constant(1, 1 - across.squaredNorm())};
  };
  const auto found = constrained_maximum(function, variables({-0.5, -0.5, -0.5}), variables({-3, -3, -3}),
                                         variables({0.2, 3, 3}), 0.05, 1e-4);
  REQUIRE(found);
  CHECK(found->point[0] == 0.2);
  // On the bound and the cylinder: the best of 60 000 points along their common curve.
  double best = -9;
  for (int i = -30000; i <= 30000; ++i) {
    // |p|^2 - (axis . p)^2 = 1 in y, for this z.
    const double x = 0.2, z = 1e-4 * i, along = axis[0] * x + axis[2] * z;
    const double a = 1 - axis[1] * axis[1], b = -axis[1] * along, c = x * x + z * z - along * along - 1;
    if (b * b - a * c >= 0) {
      const double y = (-b + std::sqrt(b * b - a * c)) / a;
      best = std::max(best, y + 2 * x + 0.1 * z);
    }
  }
  CHECK(std::abs(found->value - best) < 1e-7);  // the curve bends by 1, its points are 1e-4 apart
  CHECK(evaluations < 500);  // some twenty steps of 19 and their way back; creeping needs thousands
}

TEST_CASE("along the edge of what is defined, which the value leaves like a root") {
  // Nothing is defined outside the unit ball; 2 gap is 1e-4 on the constraint, a difference's step.
  int evaluations = 0;
  const double least = 0.01;
  const auto function = [&](const Variables& x) -> std::optional<ConstrainedValue> {
    ++evaluations;
    const double gap2 = 1 - x.squaredNorm();
    if (gap2 < 0) return std::nullopt;
    return ConstrainedValue{x[0] - 0.3 * x[1] - 4 * std::sqrt(gap2),
                            Eigen::VectorXd::Constant(1, (gap2 - least * least) / (2 * least))};
  };
  const auto found = constrained_maximum(function, variables({-0.3, 0.8, 0.4}), variables({-2, -2, -2}),
                                         variables({2, 2, 2}), 0.05, 1e-4);
  REQUIRE(found);
  const Eigen::Vector3d best = std::sqrt(1 - least * least) * Eigen::Vector3d(1, -0.3, 0).normalized();
  CHECK((found->point - best).norm() < 1e-6);
  CHECK(evaluations < 2000);
}
