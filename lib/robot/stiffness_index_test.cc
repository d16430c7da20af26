// What every index of the table promises: a new one is tested here as soon as it stands in the table.

#include "robot/stiffness_index.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <deque>
#include <set>
#include <string>

#include "base/error.h"
#include "numerics/random.h"

using namespace stablecut;
using namespace stablecut::robot;

namespace {

Eigen::Vector3d random_vector(std::mt19937_64& generator) {
  Eigen::Vector3d v;
  for (double& value : v) value = numerics::unit_normal(generator);
  return v;
}

Eigen::Matrix3d random_rotation(std::mt19937_64& generator) {
  const double angle = numerics::uniform(generator, 0.3, 3);
  return Eigen::AngleAxisd(angle, random_vector(generator).normalized()).matrix();
}

// Of the size that robots have, 0.1 to 1 um/N, and not nearly singular.
Eigen::Matrix3d random_compliance(std::mt19937_64& generator) {
  const Eigen::Matrix3d axes = random_rotation(generator);
  Eigen::Vector3d principal;
  for (double& value : principal) value = numerics::uniform(generator, 1e-7, 1e-6);
  return axes * principal.asDiagonal() * axes.transpose();
}

// A force; for an index that needs one as the mean of a cut whose forces lie about it.
ForceLoad load_of(const StiffnessIndex& index, const Eigen::Vector3d& force) {
  ForceLoad load = force;
  if (!index.needs_cut) return load;
  static std::deque<CutLoad> cuts;
  CutLoad& cut = cuts.emplace_back();
  cut.mean_n = force;
  cut.turning_n.resize(3, 3);
  cut.turning_n << 2 * force, 0.5 * force, 0.5 * force;
  cut.turning_n.row(1).tail(2) << 30, -30;
  load.cut = &cut;
  return load;
}

}  // namespace

TEST_CASE("indices are known by their names") {
  std::set<std::string> names;
  for (const StiffnessIndex& index : stiffness_indices()) {
    names.insert(index.name);
    CHECK(&stiffness_index(index.name) == &index);
  }
  CHECK(names.size() == stiffness_indices().size());
  CHECK(names.count("combined") == 1);
  CHECK_THROWS_AS(stiffness_index("soft"), InvalidArgument);
}

TEST_CASE("every index: the same in every frame, above 0, and not worse when all joints are stiffer") {
  std::mt19937_64 generator(61);
  for (const StiffnessIndex& index : stiffness_indices()) {
    INFO("index " << index.name);
    for (int n = 0; n < 50; ++n) {
      const Eigen::Matrix3d c = random_compliance(generator), tool = random_rotation(generator),
                            turn = random_rotation(generator);
      const Eigen::Vector3d force = 500 * random_vector(generator);
      const ForceLoad load = load_of(index, force);
      const double score = index.score(c, tool, load);
      CHECK(score > 0);
      // Rounding in a product of three matrices and in an eigenvalue.
      CHECK(index.score(turn * c * turn.transpose(), turn * tool, turned(load, turn)) ==
            Approx(score).epsilon(1e-13));
      const double stiffer = index.score(c / 2, tool, load);
      CHECK((index.larger_is_better ? stiffer >= score : stiffer <= score));
    }
  }
}

TEST_CASE("every index: four arms side by side score as one by one") {
  std::mt19937_64 generator(67);
  for (const StiffnessIndex& index : stiffness_indices()) {
    INFO("index " << index.name);
    for (int n = 0; n < 50; ++n) {
      const Eigen::Matrix3d tool = random_rotation(generator);
      const ForceLoad force = load_of(index, 500 * random_vector(generator));
      double entries[6][kArms], scores[kArms];
      Eigen::Matrix3d compliance[kArms];
      for (int arm = 0; arm < kArms; ++arm) {
        const Eigen::Matrix3d& c = compliance[arm] = random_compliance(generator);
        const double upper[6] = {c(0, 0), c(0, 1), c(0, 2), c(1, 1), c(1, 2), c(2, 2)};
        for (int e = 0; e < 6; ++e) entries[e][arm] = upper[e];
      }
      index.arm_scores(entries, tool, force, scores);
      for (int arm = 0; arm < kArms; ++arm) {
        // largest_arm_compliances() promises 1e-8 of the spread of the eigenvalues.
        CHECK(scores[arm] == Approx(index.score(compliance[arm], tool, force)).epsilon(1e-8));
      }
    }
  }
}

TEST_CASE("every index tells truly whether it feels the tool's turn, the tool's axes, a force and a ridge") {
  std::mt19937_64 generator(71);
  const Eigen::Matrix3d c = random_compliance(generator), tool = random_rotation(generator);
  const Eigen::Matrix3d turned_tool = tool * Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitZ()).matrix();
  const Eigen::Vector3d force(300, -200, 100), other(-100, 50, 400);
  for (const StiffnessIndex& index : stiffness_indices()) {
    INFO("index " << index.name);
    const double score = index.score(c, tool, load_of(index, force));
    // A turn of 0.7 rad or another force changes what it changes by far more than rounding.
    CHECK((std::abs(index.score(c, turned_tool, load_of(index, force)) / score - 1) > 1e-6) ==
          index.feels_tool_turn);
    CHECK((std::abs(index.score(c, tool, load_of(index, other)) / score - 1) > 1e-6) == index.needs_force);
    for (int i = 0; i < 3; ++i) {
      const Eigen::Matrix3d rigid =
          Eigen::Matrix3d::Identity() - Eigen::Vector3d::Unit(i) * Eigen::RowVector3d::Unit(i);
      CHECK(std::isinf(index.score(rigid, Eigen::Matrix3d::Identity(), load_of(index, force))) ==
            index.along[i]);
    }
    // Two equal principal compliances that part one way or the other: on a ridge the slope jumps, so that the
    // second difference over the step does not vanish with it.
    const auto at = [&](double t) {
      return index.score(Eigen::Vector3d(2 + t, 2 - t, 1).asDiagonal(), tool, load_of(index, force));
    };
    constexpr double kStep = 1e-4;
    const double jump = (at(kStep) + at(-kStep) - 2 * at(0)) / (kStep * at(0));
    CHECK((std::abs(jump) > 0.01) == index.has_ridge);
  }
}

TEST_CASE("a task feels the tool's turn where its index does, or its force turns with the tool") {
  StiffnessTask task;
  CHECK(std::string(task.index->name) == "weakest");
  CHECK_FALSE(task.feels_tool_turn());
  task.index = &stiffness_index("combined");
  CHECK(task.feels_tool_turn());
  task.index = &stiffness_index("deflection");
  task.force_n = Eigen::Vector3d(100, 0, 500);
  CHECK_FALSE(task.feels_tool_turn());
  task.force_in_tool = true;
  CHECK(task.feels_tool_turn());
  task.force_n = Eigen::Vector3d(0, 0, 500);
  CHECK_FALSE(task.feels_tool_turn());
  // An index that takes no force does not care how one is given.
  task.index = &stiffness_index("weakest");
  task.force_n = Eigen::Vector3d(100, 0, 500);
  CHECK_FALSE(task.feels_tool_turn());
}

TEST_CASE("the deflection under a load that varies is the largest, and not below that of any of its forces") {
  std::mt19937_64 generator(73);
  StiffnessTask task;
  task.index = &stiffness_index("deflection");
  for (int n = 0; n < 100; ++n) {
    const Eigen::Matrix3d c = random_compliance(generator), tool = random_rotation(generator);
    task.force_n = 300 * random_vector(generator);
    task.force_cone_rad = n % 2 ? 0.4 : 0;
    task.force_turning_n = n % 2 ? 0 : 200;
    task.force_in_tool = n % 3 == 0;
    const double score = stiffness_score(c, tool, task);
    const Eigen::Vector3d worst = worst_force(task, c, tool), mean = force_in_base(task, tool);
    CHECK((c * worst).norm() == Approx(score).epsilon(1e-12));
    const double smooth = smooth_score(c, tool, task, 100);
    CHECK(smooth >= score * (1 - 1e-12));
    CHECK(smooth <= score * 1.01);
    for (int i = 0; i < 200; ++i) {
      const double angle = 0.0314159 * i;
      const Eigen::Vector3d across = n % 2 ? mean.unitOrthogonal() : Eigen::Vector3d(tool.col(0));
      const Eigen::Vector3d axis = n % 2 ? mean.normalized() : Eigen::Vector3d(tool.col(2));
      const Eigen::Vector3d side = Eigen::AngleAxisd(angle, axis) * across;
      const Eigen::Vector3d force =
          n % 2 ? Eigen::Vector3d(std::cos(0.4) * mean + std::sin(0.4) * mean.norm() * side)
                : Eigen::Vector3d(mean + 200 * side);
      CHECK((c * force).norm() <= score * (1 + 1e-12));
    }
    // Four arms side by side.
    double entries[6][kArms], scores[kArms];
    const double upper[6] = {c(0, 0), c(0, 1), c(0, 2), c(1, 1), c(1, 2), c(2, 2)};
    for (int e = 0; e < 6; ++e) std::fill_n(entries[e], kArms, upper[e]);
    task.index->arm_scores(entries, tool, task.load(mean), scores);
    CHECK(scores[3] == Approx(score).epsilon(1e-12));
  }
}
