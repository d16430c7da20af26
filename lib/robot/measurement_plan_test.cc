#include "robot/measurement_plan.h"

#include <Eigen/LU>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "base/error.h"
#include "robot/load_fixtures_test.h"

using namespace stablecut;
using namespace stablecut::robot;
using namespace stablecut::robot::fixtures;

TEST_CASE("a plan is the best of all choices where they can be tried, and never worse than chance") {
  const Robot robot = kr360();
  auto candidates = samples_of(robot, {random_poses(robot, 4, 21), kThreeLoads});
  for (LoadSample& sample : candidates) sample.deflection_std_m = Eigen::Vector3d::Constant(5e-6);
  const std::array<bool, 3> xyz = {true, true, true};
  const auto log_det = [&](const std::vector<int>& chosen) {
    Eigen::Matrix<double, 5, 5> sum = Eigen::Matrix<double, 5, 5>::Zero();
    for (const int k : chosen) {
      const auto a =
          compliance_equations(robot, joint_springs(), {candidates[k]}, xyz).a.leftCols<5>().eval();
      sum += a.transpose() * a;
    }
    return std::log(sum.determinant());
  };
  const MeasurementPlan plan = plan_measurements(robot, candidates, {3, true, xyz});
  double best = -1e9;
  for (int i = 0; i < 12; ++i) {
    for (int j = i; j < 12; ++j) {
      for (int k = j; k < 12; ++k) best = std::max(best, log_det({i, j, k}));
    }
  }
  CHECK(log_det(plan.chosen) == Approx(best).epsilon(1e-9));
  CHECK(plan.identifiability.rank == 5);
  CHECK(std::isnan(plan.compliance_std[5]));
  CHECK(plan.efficiency <= 1);
  CHECK(plan.efficiency > 0.5);

  // What the plan promises is what the identification then gets.
  std::vector<LoadSample> measured;
  for (const int k : plan.chosen) measured.push_back(candidates[k]);
  const Identification found = identify_stiffness(robot, measured, {});
  for (int j = 0; j < 5; ++j) {
    CHECK(plan.compliance_std[j] == Approx(std::sqrt(found.covariance(j, j))).epsilon(1e-6));
  }
  CHECK_THROWS_AS(plan_measurements(robot, candidates, {1, true, xyz}), NoAnswer);
}

TEST_CASE("different measurements only, in an order of short moves; what a discrepancy costs") {
  const Robot robot = kr360();
  auto candidates = samples_of(robot, {random_poses(robot, 40, 22), kThreeLoads});
  for (LoadSample& sample : candidates) sample.deflection_std_m = Eigen::Vector3d::Constant(5e-6);
  const PlanOptions options{30};
  const MeasurementPlan plan = plan_measurements(robot, candidates, options);
  std::vector<int> sorted = plan.chosen;
  std::sort(sorted.begin(), sorted.end());
  CHECK(std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end());
  CHECK(plan_measurements(robot, candidates, {120}).chosen.size() == 120);
  CHECK_THROWS_AS(plan_measurements(robot, candidates, {121}), NoAnswer);
  // Shorter than 2000 random orders, which are some three times as long.
  const auto moves = [&](const std::vector<int>& order) {
    double sum = 0;
    for (std::size_t i = 1; i < order.size(); ++i)
      sum += (candidates[order[i]].angles - candidates[order[i - 1]].angles).cwiseAbs().maxCoeff();
    return sum;
  };
  CHECK(moves(plan.chosen) == Approx(plan.moves_rad));
  std::mt19937_64 generator(3);
  double shortest = 1e9;
  for (int run = 0; run < 2000; ++run) {
    std::shuffle(sorted.begin(), sorted.end(), generator);
    shortest = std::min(shortest, moves(sorted));
  }
  CHECK(plan.moves_rad < 0.7 * shortest);

  // The scatter of many identifications from measurements that are off by so much.
  const Discrepancy discrepancy{0.1, 20e-6, 600};
  const JointAngles c = k_theta_2d().cwiseInverse();
  const JointAngles std = std_with_discrepancy(robot, candidates, options, plan, c, discrepancy);
  JointAngles squares = JointAngles::Zero();
  constexpr int kRuns = 400;
  for (int run = 0; run < kRuns; ++run) {
    std::vector<LoadSample> measured;
    for (const int k : plan.chosen) {
      measured.push_back(candidates[k]);
      measured.back().deflection_std_m.reset();
      const double variance = 25e-12 + discrepancy.variance(candidates[k].deflection_m.norm());
      for (double& x : measured.back().deflection_m)
        x += std::sqrt(variance) * numerics::unit_normal(generator);
    }
    squares += (identify_stiffness(robot, measured, {}).compliance - c).cwiseAbs2() / kRuns;
  }
  // 400 runs know a deviation to 3.5 %.
  for (int j = 0; j < 5; ++j) {
    CHECK(std::sqrt(squares[j]) == Approx(std[j]).epsilon(0.15));
    CHECK(std[j] > 2 * plan.compliance_std[j]);
  }
  CHECK(std::isnan(std[5]));
}
