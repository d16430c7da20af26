// Mistakes put into samples of known stiffness are named, and sound samples are left in peace.
#include "robot/hypotheses.h"

#include <catch2/catch.hpp>

#include "robot/load_fixtures_test.h"

namespace stablecut::robot {
namespace {

using Kind = Hypothesis::Kind;

constexpr double kNoise = 1e-5;  // m
const Eigen::Vector3d kOffAxis(0.12, 0.05, 0.21);

std::vector<LoadSample> measured(const Robot& robot, unsigned seed, int poses = 14, bool off_axis = false) {
  fixtures::Setup setup;
  setup.poses = fixtures::random_poses(robot, poses, seed);
  setup.loads = fixtures::kThreeLoads;
  if (off_axis) setup.force_point = setup.measuring_point = kOffAxis;
  std::vector<LoadSample> samples = fixtures::samples_of(robot, setup);
  std::mt19937_64 generator(seed);
  fixtures::add_noise(samples, kNoise, 0, generator);
  return samples;
}

// What base and bearings add, a quarter as soft as the joints.
void bend(const Robot& robot, std::vector<LoadSample>& samples) {
  const auto springs = springs_of(robot, ElasticModel::kThreeAxis);
  Eigen::VectorXd compliance = Eigen::VectorXd::Zero(springs.size());
  for (std::size_t k = 0; k < springs.size(); ++k) {
    if (springs[k].kind == Spring::Kind::kBearing)
      compliance[k] = 0.25 / fixtures::k_theta_2d()[springs[k].joint];
    if (springs[k].kind == Spring::Kind::kBase) compliance[k] = 2e-8;
  }
  for (LoadSample& sample : samples) {
    const RobotPose pose = robot_pose(robot, sample.angles);
    sample.deflection_m +=
        compliance_at(pose, springs, compliance, pose.flange * sample.force_point) * sample.force_n;
  }
}

// The likeliest change; kNone where nothing is said.
Hypothesis named(const Robot& robot, const std::vector<LoadSample>& samples) {
  const auto better = better_fits(robot, samples, {});
  if (better.empty()) return {};
  CHECK(better.front().residual_after_m < better.front().residual_before_m);
  CHECK(2 * better.front().poses_better > better.front().poses);
  return better.front().hypothesis;
}

}  // namespace

TEST_CASE("sound samples have no better hypothesis, with springs that the joints lack or without") {
  for (const Robot& robot : {fixtures::kr360(), fixtures::coupled_kr360()}) {
    for (unsigned seed = 1; seed <= 10; ++seed) {
      std::vector<LoadSample> samples = measured(robot, seed);
      CHECK(named(robot, samples).kind == Kind::kNone);
      bend(robot, samples);
      CHECK(named(robot, samples).kind == Kind::kNone);
      CHECK(stiffness_of_reach(robot, samples, {}).usual);
    }
  }
}

TEST_CASE("the sign of each joint is named where it is wrong") {
  const Robot truth = fixtures::kr360();
  for (int j = 0; j < kJoints; ++j) {
    Robot robot = truth;
    robot.joints[j].theta_sign *= -1;
    std::vector<LoadSample> samples = measured(truth, 20 + j, 24, true);
    CHECK(named(robot, samples) == Hypothesis{.kind = Kind::kSign, .joint = j});
    bend(truth, samples);
    CHECK(named(robot, samples) == Hypothesis{.kind = Kind::kSign, .joint = j});
  }
}

TEST_CASE("a sign that the loads cannot tell is not named") {
  Robot truth = fixtures::kr360(), robot = truth;
  robot.joints[5].theta_sign *= -1;
  CHECK(named(robot, measured(truth, 3)).kind == Kind::kNone);  // load and measurement on axis 6
  robot = truth;
  robot.joints[0].theta_sign *= -1;
  std::vector<LoadSample> vertical = measured(truth, 4);
  std::erase_if(vertical, [](const LoadSample& sample) { return sample.force_n.z() == 0; });
  for (LoadSample& sample : vertical) sample.deflection_m.head<2>().setZero();
  HypothesisOptions only_z;
  only_z.components = {false, false, true};
  CHECK(better_fits(robot, vertical, only_z).empty());  // the arm's height does not feel axis 1
}

TEST_CASE("a coupling that lacks, or is too much, is named") {
  const Robot plain = fixtures::kr360(), coupled = fixtures::coupled_kr360();
  CHECK(named(plain, measured(coupled, 5)) ==
        Hypothesis{.kind = Kind::kCoupling, .joint = 2, .follows = 1, .ratio = -1});
  CHECK(named(coupled, measured(plain, 6)) ==
        Hypothesis{.kind = Kind::kCoupling, .joint = 2, .follows = 1, .ratio = 0});
}

TEST_CASE("deflections of a turned frame, and angles in radians, are named") {
  const Robot robot = fixtures::kr360();
  const std::vector<LoadSample> sound = measured(robot, 7);
  for (const Hypothesis& change : hypotheses(robot, sound, {})) {
    if (change.kind != Kind::kTurned) continue;
    Hypothesis back = change;
    back.vector *= -1;
    Robot same = robot;
    std::vector<LoadSample> samples = sound;
    apply(back, same, samples);
    CHECK(named(robot, samples) == change);
  }
  std::vector<LoadSample> radians = sound;
  for (LoadSample& sample : radians) sample.angles = most_central_copies(robot, sample.angles) * (kPi / 180);
  CHECK(named(robot, radians).kind == Kind::kRadians);
}

// Exact samples: what is fitted is the mistake, up to the last step of 1e-4 m or rad.
TEST_CASE("fitted vectors are the mistakes") {
  const Robot truth = fixtures::kr360();
  fixtures::Setup setup;
  setup.poses = fixtures::random_poses(truth, 16, 8);
  setup.loads = fixtures::kThreeLoads;
  const std::vector<LoadSample> exact = fixtures::samples_of(truth, setup);
  const Eigen::Vector3d turn(0.1, -0.2, 0.15), offset(0.1, 0.05, -0.15);

  std::vector<LoadSample> turned = exact;
  for (LoadSample& sample : turned) sample.deflection_m = turn_by(-turn) * sample.deflection_m;
  const Hypothesis rotated = named(truth, turned);
  CHECK(rotated.kind == Kind::kRotated);
  CHECK((rotated.vector - turn).norm() < 2e-4);

  std::vector<LoadSample> moved = exact;
  for (LoadSample& sample : moved) sample.force_point -= offset;
  const Hypothesis beside = named(truth, moved);
  CHECK(beside.kind == Kind::kLoadPoint);
  CHECK((beside.vector - offset).norm() < 2e-4);

  Robot shorter = truth;
  shorter.joints[3].d_m -= 0.2;
  const Hypothesis longer = named(shorter, exact);
  CHECK(longer.kind == Kind::kLength);
  CHECK(longer.joint == 3);
  CHECK(std::abs(longer.vector[0] - 0.2) < 2e-4);
}

TEST_CASE("a deviation turns with its deflection, and what is turned there and back is the same") {
  Robot robot = fixtures::kr360();
  std::vector<LoadSample> samples(1);
  samples[0].deflection_m = {1, 2, 3};
  samples[0].deflection_std_m = Eigen::Vector3d(4, 5, 6);
  Hypothesis turned{.kind = Kind::kTurned, .vector = {0, 0, kPi / 2}};
  apply(turned, robot, samples);
  CHECK(samples[0].deflection_m == Eigen::Vector3d(-2, 1, 3));
  CHECK(*samples[0].deflection_std_m == Eigen::Vector3d(5, 4, 6));
  turned.vector *= -1;
  apply(turned, robot, samples);
  CHECK(samples[0].deflection_m == Eigen::Vector3d(1, 2, 3));
}

TEST_CASE("the unit that a stiffness beside the usual one of the reach comes from") {
  const Robot robot = fixtures::kr360();
  const std::vector<LoadSample> sound = measured(robot, 9);
  const HypothesisOptions options{{true, true, true}, {1e3, 1e-3, 25.4}, {9.80665}};
  // a1 + a2 + the length of (a3, d4): the KR360's reach of 2826 mm.
  CHECK(std::abs(stiffness_of_reach(robot, sound, options).reach_m - 2.826) < 1e-3);
  for (const Hypothesis& unit : hypotheses(robot, sound, options)) {
    if (unit.kind != Kind::kDeflectionUnit && unit.kind != Kind::kForceUnit) continue;
    Hypothesis back = unit;
    back.factor = 1 / unit.factor;
    Robot same = robot;
    std::vector<LoadSample> samples = sound;
    apply(back, same, samples);
    const StiffnessOfReach found = stiffness_of_reach(robot, samples, options);
    CHECK_FALSE(found.usual);
    REQUIRE(found.unit);
    CHECK(*found.unit == unit);
  }
}

TEST_CASE("many samples are thinned without losing a load") {
  const Robot truth = fixtures::kr360();
  const std::vector<LoadSample> few = measured(truth, 10, 20);
  std::vector<LoadSample> many;
  for (int repeat = 0; repeat < 200; ++repeat) many.insert(many.end(), few.begin(), few.end());
  Robot robot = truth;
  robot.joints[2].theta_sign *= -1;
  CHECK(named(truth, many).kind == Kind::kNone);
  CHECK(named(robot, many) == Hypothesis{.kind = Kind::kSign, .joint = 2});
}

TEST_CASE("a residual above a third of the deflection is a misfit") {
  CHECK(misfit(0.34, 1));
  CHECK_FALSE(misfit(0.33, 1));
}

TEST_CASE(
    "deflections from where the robot would be without weight are named, and the joints found with it") {
  Robot robot = fixtures::kr360();
  const double mass_kg[] = {400, 350, 250, 60, 40, 10};
  for (int j = 0; j < kJoints; ++j) robot.joints[j].mass = LinkMass{mass_kg[j], {0.1, 0.05, 0.15}};
  for (unsigned seed = 1; seed <= 5; ++seed) {
    std::vector<LoadSample> samples = measured(robot, seed);
    CHECK(named(robot, samples).kind == Kind::kNone);
    // Each link's weight at its centre, through the joints before it, by their Jacobians.
    for (LoadSample& sample : samples) {
      const RobotPose pose = robot_pose(robot, sample.angles);
      const auto at_tool = translational_jacobian(pose, pose.flange * sample.measuring_point);
      for (int link = 0; link < kJoints; ++link) {
        Eigen::Matrix3d frame;
        const Eigen::Vector3d z = robot.joints[link].theta_sign * pose.axis.col(link);
        frame << pose.frame_x.col(link), z.cross(pose.frame_x.col(link)), z;
        const auto at_centre =
            translational_jacobian(pose, pose.point.col(link) + frame * robot.joints[link].mass->center_m);
        for (int j = 0; j <= link; ++j) {
          const double torque = -9.80665 * mass_kg[link] * at_centre(2, j);
          sample.deflection_m += torque / fixtures::k_theta_2d()[j] * at_tool.col(j);
        }
      }
    }
    const Hypothesis found = named(robot, samples);
    CHECK(found.kind == Kind::kOwnWeight);
    Robot same = robot;
    apply(found, same, samples);
    const ComplianceEquations equations =
        compliance_equations(same, joint_springs(), samples, {true, true, true});
    const Eigen::VectorXd left =
        equations.a * Eigen::VectorXd(fixtures::k_theta_2d().cwiseInverse()) - equations.b;
    CHECK(left.cwiseAbs().maxCoeff() < 5 * kNoise);  // the noise alone
  }
}

}  // namespace stablecut::robot
