#include "robot/compliance.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <catch2/catch.hpp>
#include <cmath>

#include "base/error.h"
#include "robot/inverse.h"
#include "robot/pose_report.h"
#include "robot/robot_fixtures_test.h"

using namespace stablecut;
using namespace stablecut::robot;
using namespace stablecut::robot::fixtures;

TEST_CASE("C_tt is the displacement block of the inverse of J^-T K J^-1") {
  const Robot robot = with_tool_offset(kr360(), 0.1);
  std::mt19937_64 generator(5);
  const JointAngles k = k_theta_2d();
  int compared = 0;
  for (int n = 0; n < 30; ++n) {
    const RobotPose pose = robot_pose(robot, random_angles(robot, generator));
    if (singularity_margin(pose) < 0.05) continue;
    ++compared;
    const Matrix6d inverse = jacobian(pose, pose.tool.translation()).inverse();
    const Matrix6d stiffness = inverse.transpose() * k.asDiagonal() * inverse;
    const Eigen::Matrix3d expected = Matrix6d(stiffness.inverse()).topLeftCorner<3, 3>();
    const Eigen::Matrix3d compliance = translational_compliance(pose, k.cwiseInverse());
    CHECK((compliance - expected).norm() < 1e-10 * expected.norm());
  }
  CHECK(compared > 20);
}

TEST_CASE("directional stiffness by principal stiffnesses, eq. 14") {
  const RobotPose pose = robot_pose(kr360(), (JointAngles() << 0.1, -1.5, 1.4, 0.3, 1.2, 0.2).finished());
  const Eigen::Matrix3d compliance = translational_compliance(pose, k_theta_2d().cwiseInverse());
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(compliance);
  const Eigen::Vector3d kappa = solver.eigenvalues().cwiseInverse();
  CHECK((principal_compliances(compliance) - solver.eigenvalues().reverse()).norm() <
        1e-14 * kappa.cwiseInverse().norm());
  double sum = 0;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d u = pose.tool.linear().col(i);
    const double by_axes =
        1 / std::sqrt((solver.eigenvectors().transpose() * u).cwiseQuotient(kappa).squaredNorm());
    CHECK(directional_stiffness(compliance, u) == Approx(by_axes).epsilon(1e-12));
    sum += by_axes * by_axes;
  }
  StiffnessTask task;
  task.index = &stiffness_index("combined");
  CHECK(stiffness_score(compliance, pose.tool.linear(), task) == Approx(std::sqrt(sum)).epsilon(1e-12));
  task.index = &stiffness_index("weakest");
  CHECK(stiffness_score(compliance, pose.tool.linear(), task) == Approx(kappa.minCoeff()).epsilon(1e-12));
  task.index = &stiffness_index("deflection");
  CHECK_THROWS_AS(stiffness_score(compliance, pose.tool.linear(), task), InvalidArgument);
  // The same force given in either frame.
  const Eigen::Vector3d force(10, 20, -30);
  task.force_n = force;
  const double in_base = stiffness_score(compliance, pose.tool.linear(), task);
  task.force_n = Eigen::Vector3d(pose.tool.linear().transpose() * force);
  task.force_in_tool = true;
  CHECK(stiffness_score(compliance, pose.tool.linear(), task) == Approx(in_base).epsilon(1e-12));
}

TEST_CASE("principal compliances where two or three are equal") {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, -1).normalized()).matrix();
  for (const Eigen::Vector3d& values :
       {Eigen::Vector3d(3, 3, 1), Eigen::Vector3d(3, 1, 1), Eigen::Vector3d(2, 2, 2),
        Eigen::Vector3d(1, 1e-3, 0), Eigen::Vector3d(1, 1 - 1e-9, 0.5)}) {
    const Eigen::Matrix3d matrix = turn * values.asDiagonal() * turn.transpose();
    CHECK((principal_compliances(matrix) - values).norm() < 1e-14);
  }
}

TEST_CASE("the four arms' compliances are those of the joints' Jacobians") {
  for (const double offset : {0.0, 0.2}) {
    const Robot robot = with_tool_offset(kr360(), offset);
    const InverseKinematics inverse(robot);
    const JointAngles c = k_theta_2d().cwiseInverse();
    std::mt19937_64 generator(6);
    int compared = 0;
    for (int n = 0; n < 200; ++n) {
      const Eigen::Isometry3d tool = robot_pose(robot, random_angles(robot, generator)).tool;
      ArmLanes lanes;
      solve_arms(inverse.constants(), inverse.target_of(tool), lanes);
      const Eigen::Vector3d point = inverse.home_from_base() * tool.translation();
      double entries[6][kArms], largest[kArms];
      arm_compliances(lanes, point.data(), c.data(), entries);
      largest_arm_compliances(entries, largest);
      for (int b = 0; b < kBranches; ++b) {
        if (!std::isfinite(lanes.limit_margin[b])) continue;
        JointAngles angles;
        for (int j = 0; j < kJoints; ++j) angles[j] = lanes.angle[j][b];
        const Eigen::Matrix3d expected = translational_compliance(robot_pose(robot, angles), c);
        const int i = b % kArms;
        Eigen::Matrix3d home;
        home << entries[0][i], entries[1][i], entries[2][i], entries[1][i], entries[3][i], entries[4][i],
            entries[2][i], entries[4][i], entries[5][i];
        const Eigen::Matrix3d to_home = inverse.home_from_base().linear();
        REQUIRE((to_home.transpose() * home * to_home - expected).norm() < 1e-11 * expected.norm());
        REQUIRE(largest[i] == Approx(principal_compliances(expected)[0]).epsilon(1e-8));
        ++compared;
      }
    }
    CHECK(compared > 800);
  }
}

TEST_CASE("deviations of a pose's score by sampling") {
  const Robot robot = kr360();
  const JointAngles c = k_theta_2d().cwiseInverse();
  Matrix6d covariance = Matrix6d::Zero();
  for (int j = 0; j < kJoints; ++j) covariance(j, j) = std::pow(0.05 * c[j], 2);
  covariance(1, 2) = covariance(2, 1) = -0.6 * std::sqrt(covariance(1, 1) * covariance(2, 2));
  StiffnessTask task;
  task.index = &stiffness_index("deflection");
  task.force_n = Eigen::Vector3d(0, 0, -588.6);
  const auto deg = [](double d) { return radians_from_degrees(d); };
  const JointAngles first = (JointAngles() << 0, deg(-100), deg(110), 0, deg(83.7), 0).finished();
  const JointAngles second = (JointAngles() << 0, deg(-95), deg(104), 0, deg(81), 0).finished();
  const ElasticityErrors errors{covariance, {}};
  const PoseReport a = report_pose(robot, first, task, joints_only(c), errors);
  const PoseReport b = report_pose(robot, second, task, joints_only(c), errors);
  REQUIRE(a.score_std);
  CHECK(*a.score_std == Approx(*a.deflection_std_m).epsilon(1e-9));
  std::mt19937_64 generator(7);
  const Eigen::LLT<Matrix6d> factor(covariance);
  double sum = 0, squares = 0;
  int better = 0;
  constexpr int kDraws = 20000;
  for (int n = 0; n < kDraws; ++n) {
    JointAngles z;
    for (double& value : z) value = numerics::unit_normal(generator);
    const JointAngles drawn = c + factor.matrixL() * z;
    const double score_a = report_pose(robot, first, task, joints_only(drawn), {}).score;
    better += score_a < report_pose(robot, second, task, joints_only(drawn), {}).score;
    sum += score_a;
    squares += score_a * score_a;
  }
  const double mean = sum / kDraws, std = std::sqrt(squares / kDraws - mean * mean);
  // 20000 draws give a deviation to 0.5 % and a probability to 0.35 %.
  CHECK(*a.score_std == Approx(std).epsilon(0.02));
  CHECK(probability_better(a, b, task, errors) == Approx(static_cast<double>(better) / kDraws).margin(0.015));
}
