#include "robot/cut_deflection.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "base/error.h"
#include "robot/path_fixtures_test.h"
#include "robot/path_offset.h"
#include "robot/path_search.h"

using namespace stablecut;
using namespace stablecut::robot;
using namespace stablecut::robot::fixtures;

namespace {

StiffnessTask cut_task(std::mt19937_64& generator, const char* index = "surface") {
  StiffnessTask task;
  task.index = &stiffness_index(index);
  task.cut = std::make_shared<CutLoad>(random_cut(generator));
  task.feed =
      Eigen::Vector3d(uniform(generator, -1, 1), uniform(generator, -1, 1), uniform(generator, -1, 1));
  return task;
}

}  // namespace

TEST_CASE("the cut's frame: the wall of up milling is left of the feed, seen from the spindle") {
  const Eigen::Vector3d down = -Eigen::Vector3d::UnitZ();
  CHECK((cut_frame(Eigen::Vector3d::UnitX(), down) - Eigen::Matrix3d::Identity()).norm() < 1e-15);
  // Along y: its left is -x. What runs along the axis does not count, nor does the length.
  const Eigen::Matrix3d along_y = cut_frame({0, 7, 3}, down);
  CHECK((along_y.col(0) - Eigen::Vector3d::UnitY()).norm() < 1e-15);
  CHECK((along_y.col(1) + Eigen::Vector3d::UnitX()).norm() < 1e-15);
  // The tool points along x, the spindle behind it: with the feed upwards (z) the left is y.
  const Eigen::Matrix3d wall = cut_frame(Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitX());
  CHECK((wall.col(1) - Eigen::Vector3d::UnitY()).norm() < 1e-15);
  CHECK(wall.determinant() == Approx(1).epsilon(1e-14));
  CHECK_FALSE(across_tool({0, 0, 2}, down));
  CHECK_FALSE(across_tool({0, 0, 0}, down));
  CHECK_THROWS_AS(cut_frame({0, 0, 2}, down), InvalidArgument);
}

TEST_CASE("deflections under a cut are the compliance times its forces, turn by turn") {
  std::mt19937_64 generator(31);
  const ElasticityErrors none;
  for (int n = 0; n < 40; ++n) {
    const Robot robot = n % 2 == 0 ? kr360() : with_tool_offset(kr360(), 0.2);
    const Elasticity elasticity =
        random_elasticity(robot, n % 4 < 2 ? ElasticModel::kJointsOnly : ElasticModel::kBase, generator);
    const RobotPose pose = robot_pose(robot, random_angles(robot, generator));
    StiffnessTask task = cut_task(generator);
    CutLoad cut = *task.cut;
    cut.walls.push_back({false, cut.turning_n.rightCols(5)});
    cut.walls.push_back({false, Eigen::Matrix3Xd(3, 0)});
    task.cut = std::make_shared<CutLoad>(cut);
    const CutDeflection found = cut_deflection(pose, task, elasticity, none);
    const Eigen::Matrix3d c = translational_compliance(pose, elasticity);
    const Eigen::Matrix3d frame = cut_frame(task.feed, pose.tool.linear().col(2));
    const auto moved = [&](const Eigen::Vector3d& force) -> Eigen::Vector3d {
      return frame.transpose() * (c * (frame * force));
    };
    const double size = moved(cut.mean_n).norm();
    Eigen::Vector3d largest = Eigen::Vector3d::Zero();
    double longest = 0;
    for (const Eigen::Vector3d& force : cut.turning_n.colwise()) {
      largest = largest.cwiseMax(moved(force).cwiseAbs());
      longest = std::max(longest, moved(force).norm());
    }
    for (int axis = 0; axis < 3; ++axis) {
      CHECK(std::abs(found.mean[axis].m - moved(cut.mean_n)[axis]) < 1e-12 * size);
      CHECK(std::abs(found.largest[axis].m - largest[axis]) < 1e-12 * size);
      CHECK_FALSE(found.mean[axis].std_m);
    }
    // Material is left of the feed's left wall where the tool gives way to the right.
    REQUIRE(found.walls.size() == 3);
    CHECK(found.walls[0].mean_error.m == -found.mean[1].m);
    CHECK(found.walls[1].mean_error.m == found.mean[1].m);
    for (int w = 0; w < 2; ++w) {
      double error = 0;
      for (const Eigen::Vector3d& force : cut.walls[w].leaving_n.colwise()) {
        const double here = moved(force)[1] * (w == 0 ? -1 : 1);
        if (std::abs(here) > std::abs(error)) error = here;
      }
      REQUIRE(found.walls[w].error);
      CHECK(std::abs(found.walls[w].error->m - error) < 1e-12 * size);
    }
    CHECK_FALSE(found.walls[2].error);
    // The indices are the largest of these.
    CHECK(stiffness_score(c, pose.tool.linear(), task) == Approx(largest[1]).epsilon(1e-12));
    task.index = &stiffness_index("feed");
    CHECK(stiffness_score(c, pose.tool.linear(), task) == Approx(largest[0]).epsilon(1e-12));
    task.index = &stiffness_index("deflection");
    CHECK(stiffness_score(c, pose.tool.linear(), task) == Approx(longest).epsilon(1e-12));
    CHECK((c * worst_force(task, c, pose.tool.linear())).norm() == Approx(longest).epsilon(1e-12));
  }
}

TEST_CASE("the smooth largest of a turn lies above it, and by no more than n^(1/P)") {
  std::mt19937_64 generator(32);
  for (int n = 0; n < 50; ++n) {
    const CutLoad cut = random_cut(generator);
    const Eigen::RowVector3d yields = 1e-7 * Eigen::RowVector3d(numerics::unit_normal(generator), 1, 0.3);
    const double largest = largest_component(yields, cut.turning_n);
    for (const double power : {30.0, 3000.0}) {
      const double smooth = largest_component(yields, cut.turning_n, 1 / power);
      CHECK(smooth >= largest);
      CHECK(smooth <= largest * std::pow(static_cast<double>(cut.turning_n.cols()), 1 / power));
    }
  }
  // No force at all.
  CHECK(largest_component(Eigen::RowVector3d(1, 1, 1), Eigen::Matrix3Xd::Zero(3, 4), 0.1) == 0);
}

TEST_CASE(
    "deviations under a cut, by sampling the springs; the discrepancy is that of the whole deflection") {
  std::mt19937_64 generator(33);
  const Robot robot = with_tool_offset(kr360(), 0.2);
  const RobotPose pose = robot_pose(robot, random_angles(robot, generator));
  const Elasticity elasticity = joints_only(k_theta_2d().cwiseInverse());
  const StiffnessTask task = cut_task(generator);
  ElasticityErrors errors;
  const Eigen::VectorXd spread = 0.02 * elasticity.compliance;
  errors.covariance = Eigen::MatrixXd(spread.cwiseAbs2().asDiagonal());
  const CutDeflection found = cut_deflection(pose, task, elasticity, errors);
  constexpr int kDraws = 20000;
  Eigen::Matrix<double, 5, 1> sum = Eigen::Matrix<double, 5, 1>::Zero(), squares = sum;
  const auto numbers = [](const CutDeflection& d) {
    return (Eigen::Matrix<double, 5, 1>() << d.mean[0].m, d.mean[1].m, d.mean[2].m, d.largest[1].m,
            d.walls[0].error->m)
        .finished();
  };
  for (int i = 0; i < kDraws; ++i) {
    Elasticity drawn = elasticity;
    for (Eigen::Index k = 0; k < spread.size(); ++k)
      drawn.compliance[k] += spread[k] * numerics::unit_normal(generator);
    const auto draw = numbers(cut_deflection(pose, task, drawn, {}));
    sum += draw;
    squares += draw.cwiseAbs2();
  }
  const Eigen::Matrix<double, 5, 1> mean = sum / kDraws;
  const Eigen::Matrix<double, 5, 1> std = (squares / kDraws - mean.cwiseAbs2()).cwiseSqrt();
  const double stated[] = {*found.mean[0].std_m, *found.mean[1].std_m, *found.mean[2].std_m,
                           *found.largest[1].std_m, *found.walls[0].error->std_m};
  // A standard deviation from 20 000 draws has one of 0.5 %.
  for (int i = 0; i < 5; ++i) CHECK(stated[i] == Approx(std[i]).epsilon(0.03));
  errors.covariance.reset();
  errors.discrepancy = {0.1, 20e-6, 0};
  const Eigen::Matrix3d c = translational_compliance(pose, elasticity);
  const double length = (c * force_in_base(task, pose.tool.linear())).norm();
  const CutDeflection off = cut_deflection(pose, task, elasticity, errors);
  for (const auto& value : off.mean) CHECK(*value.std_m == Approx(std::hypot(0.1 * length, 20e-6)));
  const double longest = (c * worst_force(task, c, pose.tool.linear())).norm();
  for (const auto& value : off.largest) CHECK(*value.std_m == Approx(std::hypot(0.1 * longest, 20e-6)));
  // And the score's is that of the same number.
  JointAngles angles = JointAngles::Zero();
  angles[1] = -1.2, angles[2] = 1.4;
  const PoseReport report = report_pose(robot, angles, task, elasticity, errors);
  CHECK(*report.score_std == Approx(*report.cut->largest[1].std_m).epsilon(1e-12));
  CHECK(report.score == Approx(report.cut->largest[1].m).epsilon(1e-12));
}

TEST_CASE("the offset brings the tool point back to where the path wants it, also of a soft robot") {
  std::mt19937_64 generator(34);
  int moved = 0;
  for (const PathCell& cell : path_cells()) {
    const InverseKinematics inverse(cell.robot);
    for (int n = 0; n < 20; ++n) {
      // Down to a hundredth of the stiffness: deflections of centimetres.
      const double softness = std::pow(10, uniform(generator, 0, 2));
      const Elasticity elasticity = joints_only(softness * cell.stiffness.cwiseInverse());
      const StiffnessTask task = cut_task(generator);
      const JointAngles angles = random_angles(cell.robot, generator);
      if (singularity_margin(robot_pose(cell.robot, angles)) < 0.1) continue;
      const PoseReport report = report_pose(cell.robot, angles, task, elasticity, {});
      const Eigen::Vector3d offset = cancelling_offset(cell.robot, inverse, report, task, elasticity);
      Eigen::Isometry3d commanded = report.tool;
      commanded.translation() += offset;
      const auto solutions = inverse.solve(commanded, angles);
      double nearest = 1e9, left = 1e9;
      for (const InverseSolution& solution : solutions) {
        double apart = 0;
        for (int j = 0; j < kJoints; ++j)
          apart = std::max(apart, std::abs(std::remainder(solution.angles[j] - angles[j], kTwoPi)));
        if (apart >= nearest) continue;
        nearest = apart;
        const PoseReport there = report_pose(cell.robot, solution.angles, task, elasticity, {});
        left = (there.tool.translation() + *there.deflection_m - report.tool.translation()).norm();
      }
      INFO(cell.name << ", deflection " << report.deflection_m->norm() << " m");
      // The last step's change times what a change of place makes of the deflection.
      CHECK(left < 1e-9);
      if ((offset + *report.deflection_m).norm() > 1e-6) ++moved;
    }
  }
  CHECK(moved > 10);  // by more than a micrometre beside what the pose itself yields
}

TEST_CASE("along a path the feed is its own: what a point costs is the report's score") {
  std::mt19937_64 generator(35);
  for (const PathCell& cell : path_cells()) {
    PathTask task;
    task.path = circle_path(cell, 40, 0.05);
    task.stiffness = cut_task(generator);
    task.elasticity = joints_only(cell.stiffness.cwiseInverse());
    task.limit_margin_rad = 0;
    task.singularity_margin = 0.01;
    const PathModel model(cell.robot, task);
    const PathSearch search = search_path(model, 1);
    REQUIRE_FALSE(search.parts.empty());
    for (const PathPart& part : search.parts) {
      for (std::size_t i = 0; i < part.poses.size(); ++i) {
        const std::size_t point = part.first + i;
        const StiffnessTask at = point_task(task, model.frames(), point);
        const PoseReport report = report_pose(cell.robot, part.poses[i].angles, at, task.elasticity, {});
        CHECK(report.score == Approx(part.poses[i].cost).epsilon(1e-9));
        // The circle is driven counter-clockwise as seen from above: its middle is on the left.
        if (point + 1 == task.path.size()) continue;  // its feed is that of the last chord, not the next
        const Eigen::Vector3d inwards = cell.workpiece - task.path[point].position;
        CHECK(report.cut->frame.col(1).dot(inwards.normalized()) > 0.99);
      }
    }
  }
}
