// Bases and bearings that yield: the kernel, what is said of a pose, and the search.
#include <catch2/catch.hpp>
#include <cmath>

#include "robot/arm_springs.h"
#include "robot/pose_report.h"
#include "robot/search_fixtures_test.h"

using namespace stablecut;
using namespace stablecut::robot;
using namespace stablecut::robot::fixtures;

namespace {

// The joints of the KR360 and these springs.
Elasticity with_springs(const std::vector<std::pair<Spring, double>>& others) {
  Elasticity elasticity = joints_only(k_theta_2d().cwiseInverse());
  elasticity.compliance.conservativeResize(kJoints + static_cast<Eigen::Index>(others.size()));
  for (const auto& [spring, compliance] : others) {
    elasticity.compliance[static_cast<Eigen::Index>(elasticity.springs.size())] = compliance;
    elasticity.springs.push_back(spring);
  }
  return elasticity;
}

constexpr Spring base_spring(int axis) { return {Spring::Kind::kBase, 0, axis}; }
constexpr Spring bearing(int joint, int axis) { return {Spring::Kind::kBearing, joint, axis}; }

}  // namespace

TEST_CASE("the four arms' compliances are those of all springs") {
  // Every bearing, those too that a model leaves out because another spring does the same.
  std::mt19937_64 generator(41);
  int compared = 0;
  for (unsigned seed = 0; seed < 30; ++seed) {
    const Robot robot = random_robot(seed);
    Elasticity elasticity = random_elasticity(robot, ElasticModel::kJointsOnly, generator);
    std::vector<Spring> others;
    for (int axis = 0; axis < 3; ++axis) others.push_back(base_spring(axis));
    for (int j = 0; j < kJoints && seed % 2 == 0; ++j) {
      for (int axis = 0; axis < 2; ++axis) others.push_back(bearing(j, axis));
    }
    for (const Spring& spring : others) {
      elasticity.springs.push_back(spring);
      elasticity.compliance.conservativeResize(elasticity.compliance.size() + 1);
      elasticity.compliance.tail<1>()[0] = random_compliance(spring, generator);
    }
    const InverseKinematics inverse(robot);
    const Eigen::Matrix3d to_home = inverse.home_from_base().linear();
    const ArmSprings springs = arm_springs(robot, elasticity, inverse);
    for (int n = 0; n < 30; ++n) {
      const Eigen::Isometry3d tool = robot_pose(robot, random_angles(robot, generator)).tool;
      ArmLanes lanes;
      solve_arms(inverse.constants(), inverse.target_of(tool), lanes);
      const Eigen::Vector3d point = inverse.home_from_base() * tool.translation();
      double entries[6][kArms];
      arm_compliances(lanes, point.data(), springs.joint, entries);
      add_spring_compliances(lanes, springs, point.data(), entries);
      for (int b = 0; b < kBranches; ++b) {
        if (!std::isfinite(lanes.limit_margin[b])) continue;
        JointAngles angles;
        for (int j = 0; j < kJoints; ++j) angles[j] = lanes.angle[j][b];
        const RobotPose pose = robot_pose(robot, angles);
        // Nearer to a singularity the angles' own rounding grows.
        if (singularity_margin(pose) < 0.05) continue;
        const Eigen::Matrix3d expected = translational_compliance(pose, elasticity);
        const int i = b % kArms;
        Eigen::Matrix3d home;
        home << entries[0][i], entries[1][i], entries[2][i], entries[1][i], entries[3][i], entries[4][i],
            entries[2][i], entries[4][i], entries[5][i];
        INFO("robot " << seed << ", branch " << b);
        REQUIRE((to_home.transpose() * home * to_home - expected).norm() < 1e-12 * expected.norm());
        ++compared;
      }
    }
  }
  CHECK(compared > 2000);
}

TEST_CASE("a force moves the tool point by what each spring gives way") {
  // The base by c F; a bearing turns about its axis by c times the moment of F about it.
  const Robot robot = kr360();
  const JointAngles angles = (JointAngles() << 0.1, -1.5, 1.4, 0.3, 1.2, 0.2).finished();
  const RobotPose pose = robot_pose(robot, angles);
  const Eigen::Vector3d force(300, -200, -400);
  const auto moved_more = [&](const Spring& spring, double c) {
    const Elasticity more = with_springs({{spring, c}}), less = with_springs({});
    return Eigen::Vector3d((translational_compliance(pose, more) - translational_compliance(pose, less)) *
                           force);
  };
  CHECK((moved_more(base_spring(1), 1e-7) - Eigen::Vector3d(0, -2e-5, 0)).norm() < 1e-18);
  const Eigen::Vector3d arm = pose.tool.translation() - pose.point.col(2), x = pose.frame_x.col(2);
  const double turn = 1e-6 * x.dot(arm.cross(force));
  const Eigen::Vector3d turned = Eigen::AngleAxisd(turn, x) * arm - arm;
  // A rotation against its first order: half the turn's square times the arm.
  CHECK((moved_more(bearing(2, 0), 1e-6) - turned).norm() < turn * turn * arm.norm());
}

TEST_CASE("deviations: all springs' covariance, and what a new pose is off by") {
  const Robot robot = with_tool_offset(kr360(), 0.1);
  std::mt19937_64 generator(43);
  const Elasticity elasticity = random_elasticity(robot, ElasticModel::kThreeAxis, generator);
  const auto n = elasticity.compliance.size();
  Eigen::MatrixXd half(n, n);
  for (double& value : half.reshaped()) value = 1e-9 * numerics::unit_normal(generator);
  ElasticityErrors errors;
  errors.covariance = half * half.transpose();
  const JointAngles angles = (JointAngles() << 0.1, -1.5, 1.4, 0.3, 1.2, 0.2).finished();
  StiffnessTask task;
  task.force_n = Eigen::Vector3d(300, -200, -400);
  const StiffnessTask without_cut = task;
  for (const StiffnessIndex& index : stiffness_indices()) {
    task = without_cut;
    if (index.needs_cut) with_cut(task, generator);
    task.index = &index;
    INFO(index.name);
    // The slope by larger differences, of the whole report.
    const PoseReport report = report_pose(robot, angles, task, elasticity, errors);
    Eigen::VectorXd slope(n);
    for (Eigen::Index k = 0; k < n; ++k) {
      Elasticity more = elasticity, less = elasticity;
      const double step = 1e-4 * elasticity.compliance[k];
      more.compliance[k] += step;
      less.compliance[k] -= step;
      slope[k] = (report_pose(robot, angles, task, more, {}).score -
                  report_pose(robot, angles, task, less, {}).score) /
                 (2 * step);
    }
    const double by_compliances = std::sqrt(slope.dot(*errors.covariance * slope));
    CHECK(*report.score_std == Approx(by_compliances).epsilon(1e-6));
    // A share of a stiffness is that share of its inverse, to first order; of a component the share of the
    // whole deflection.
    const double share = 0.1 * (index.needs_cut ? report.largest_deflection_m : report.score);
    ElasticityErrors both = errors;
    both.discrepancy = {0.1, 0, 500};
    CHECK(*report_pose(robot, angles, task, elasticity, both).score_std ==
          Approx(std::hypot(by_compliances, share)).epsilon(1e-6));
    ElasticityErrors alone;
    alone.discrepancy = {0.1, 0, 500};
    const PoseReport off = report_pose(robot, angles, task, elasticity, alone);
    CHECK(*off.score_std == Approx(share).epsilon(1e-12));
    CHECK(*off.deflection_std_m == Approx(0.1 * report.deflection_m->norm()).epsilon(1e-12));
  }
  task = without_cut;
  task.index = &stiffness_index("deflection");
  // The absolute part: of a deflection as it is, of a stiffness by the deflection under the campaign's load.
  ElasticityErrors absolute;
  absolute.discrepancy = {0, 20e-6, 500};
  CHECK(*report_pose(robot, angles, task, elasticity, absolute).deflection_std_m ==
        Approx(20e-6).epsilon(1e-12));
  task.index = &stiffness_index("axial");
  const PoseReport axial = report_pose(robot, angles, task, elasticity, absolute);
  CHECK(*axial.score_std / axial.score == Approx(20e-6 / (500 / axial.score)).epsilon(1e-12));
  // Without its load it is taken as of the task's, and without that left out.
  absolute.discrepancy.force_n = 0;
  CHECK(*report_pose(robot, angles, task, elasticity, absolute).score_std / axial.score ==
        Approx(20e-6 / (task.force_n->norm() / axial.score)).epsilon(1e-12));
  task.force_n.reset();
  CHECK(*report_pose(robot, angles, task, elasticity, absolute).score_std == 0);
}

TEST_CASE("two poses are off each by themselves: better by chance of the difference") {
  const Robot robot = kr360();
  const Elasticity elasticity = joints_only(k_theta_2d().cwiseInverse());
  StiffnessTask task;
  task.index = &stiffness_index("deflection");
  task.force_n = Eigen::Vector3d(0, 0, -588.6);
  ElasticityErrors errors;
  errors.discrepancy = {0.1, 10e-6, 588.6};
  const JointAngles first = (JointAngles() << 0, -1.7, 1.9, 0, 1.4, 0).finished();
  const JointAngles second = (JointAngles() << 0, -1.6, 1.8, 0, 1.4, 0).finished();
  const PoseReport a = report_pose(robot, first, task, elasticity, errors),
                   b = report_pose(robot, second, task, elasticity, errors);
  std::mt19937_64 generator(44);
  int better = 0;
  constexpr int kDraws = 20000;
  for (int n = 0; n < kDraws; ++n) {
    const auto shown = [&](const PoseReport& report) {
      return report.score * (1 + 0.1 * numerics::unit_normal(generator)) +
             10e-6 * numerics::unit_normal(generator);
    };
    better += shown(a) < shown(b);
  }
  // 20000 draws give a probability to 0.35 %.
  CHECK(probability_better(a, b, task, errors) == Approx(static_cast<double>(better) / kDraws).margin(0.015));
}

TEST_CASE("what turns freely with a base and bearings that yield", "[campaign]") {
  const Robot robot = kr360();
  int flipped = 0;
  struct Case {
    std::vector<std::pair<Spring, double>> springs;
    bool base_turn, redundancy_matters;
  };
  for (const Case& c :
       {Case{{{base_spring(0), 5e-8}, {base_spring(1), 5e-8}, {base_spring(2), 1e-8}}, true, false},
        Case{{{base_spring(0), 5e-8}, {base_spring(1), 2e-8}}, false, false},
        Case{{{base_spring(2), 5e-8}}, true, false},
        Case{{{bearing(0, 0), 2e-7}, {bearing(1, 1), 1e-7}}, true, false},
        Case{{{bearing(5, 0), 2e-7}, {bearing(5, 1), 2e-7}}, true, false},
        Case{{{bearing(5, 0), 2e-6}}, true, true}}) {
    PoseTask task = tool_down(robot, 1.6, "weakest", 2);
    task.elasticity = with_springs(c.springs);
    const PoseScanner scanner(robot, task);
    CHECK(symmetry_of(scanner).base_turn == c.base_turn);
    CHECK(symmetry_of(scanner).tool_turn == !c.redundancy_matters);
    CHECK(scanner.redundancy_matters() == c.redundancy_matters);
    // What is said to be free is: the score stays as joint 1 or joint 6 turns, and moves where it is not.
    const FoundPose best = search_poses(robot, task, 0, 2).best;
    const auto change = [&](int joint) {
      double largest = 0;
      for (const double turn : {0.4, 0.9, 2.0}) {
        JointAngles angles = best.angles;
        angles[joint] += turn;
        const double score = report_pose(robot, angles, task.stiffness, task.elasticity, {}).score;
        largest = std::max(largest, std::abs(score / best.score - 1));
      }
      return largest;
    };
    CHECK((change(0) < 1e-10) == c.base_turn);
    CHECK((change(5) < 1e-10) == !c.redundancy_matters);
    const PoseSearch search = search_poses(robot, task, 0, 2);
    CHECK(has_family(search, PoseFamily::Kind::kBaseTurn) == c.base_turn);
    for (const PoseFamily& family : search.families) {
      if (family.kind != PoseFamily::Kind::kFlippedWrist) continue;
      ++flipped;
      CHECK(report_pose(robot, family.angles, task.stiffness, task.elasticity, {}).score ==
            Approx(search.best.score).epsilon(1e-10));
    }
  }
  CHECK(flipped > 0);
}

TEST_CASE("the search is never beaten by random poses, whatever yields", "[campaign]") {
  std::mt19937_64 generator(45);
  for (int n = 0; n < 8; ++n) {
    const Robot robot = with_tool_offset(kr360(), n % 4 < 2 ? 0 : 0.15);
    PoseTask task = tool_down(robot, uniform(generator, 0.8, 2.0),
                              stiffness_indices()[n % stiffness_indices().size()].name, 2);
    task.stiffness.force_n = Eigen::Vector3d(uniform(generator, -500, 500), uniform(generator, -500, 500),
                                             uniform(generator, -500, 500));
    if (task.stiffness.index->needs_cut) with_cut(task.stiffness, generator);
    task.elasticity =
        random_elasticity(robot, n % 2 == 0 ? ElasticModel::kBase : ElasticModel::kThreeAxis, generator);
    task.x.count = task.y.count = 5;
    const PoseSearch search = search_poses(robot, task, 0, 2);
    INFO("task " << n << ", score " << search.best.score);
    CHECK(report_pose(robot, search.best.angles, task.stiffness, task.elasticity, {}).score ==
          Approx(search.best.score).epsilon(1e-10));
    check_not_beaten(robot, task, search.best, 3000, generator);
  }
}
