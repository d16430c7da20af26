#include "robot/measurement_plan.h"

#include <Eigen/LU>
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
      const auto a = compliance_equations(robot, {candidates[k]}, xyz).a.leftCols<5>().eval();
      sum += a.transpose() * a;
    }
    return std::log(sum.determinant());
  };
  const MeasurementPlan plan = plan_measurements(robot, candidates, xyz, 3);
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
  CHECK_THROWS_AS(plan_measurements(robot, candidates, xyz, 1), NoAnswer);
}
