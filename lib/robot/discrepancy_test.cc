// What is said of new poses when the robot bends in ways that the fitted model lacks, and which model is
// chosen.
#include "robot/discrepancy.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "robot/load_fixtures_test.h"

using namespace stablecut;
using namespace stablecut::robot;
using namespace stablecut::robot::fixtures;

namespace {

// A robot whose foundation, bearings and upper arm yield too, by `size` of what its joints yield.
struct YieldingRobot {
  Robot robot = kr360();
  std::vector<Spring> springs = springs_of(robot, ElasticModel::kThreeAxis);
  Eigen::VectorXd compliance;
  double upper_arm = 0;

  YieldingRobot(ElasticModel model, double size, bool arm_bends, std::mt19937_64& generator) {
    compliance = Eigen::VectorXd::Zero(springs.size());
    for (std::size_t k = 0; k < springs.size(); ++k) {
      const double of_joint = 1 / k_theta_2d()[springs[k].joint], share = size * uniform(generator, 0.1, 1);
      if (springs[k].kind == Spring::Kind::kJoint) compliance[k] = of_joint;
      if (springs[k].kind == Spring::Kind::kBase && model != ElasticModel::kJointsOnly)
        compliance[k] = share * of_joint;
      if (springs[k].kind == Spring::Kind::kBearing && model == ElasticModel::kThreeAxis)
        compliance[k] = share * of_joint;
    }
    if (arm_bends) upper_arm = size * uniform(generator, 0.1, 1) / k_theta_2d()[1];
  }

  Eigen::Matrix3d compliance_of(const RobotPose& pose) const {
    const Eigen::Vector3d point = pose.tool.translation();
    const Eigen::Vector3d middle = 0.5 * (pose.point.col(1) + pose.point.col(2));
    Eigen::Matrix3d sum = compliance_at(pose, springs, compliance, point);
    for (const Eigen::Vector3d& axis :
         {Eigen::Vector3d(pose.axis.col(1)), Eigen::Vector3d(pose.frame_x.col(1))}) {
      const Eigen::Vector3d v = axis.cross(point - middle);
      sum += upper_arm * v * v.transpose();
    }
    return sum;
  }

  LoadSample measured(const JointAngles& angles, const Eigen::Vector3d& force, double noise_m,
                      std::mt19937_64& generator) const {
    LoadSample sample;
    sample.angles = angles;
    sample.force_n = force;
    sample.force_point = sample.measuring_point = robot.tool.translation();
    sample.deflection_m = compliance_of(robot_pose(robot, angles)) * force;
    for (double& x : sample.deflection_m) x += noise_m * numerics::unit_normal(generator);
    return sample;
  }

  std::vector<LoadSample> campaign(int poses, double noise_m, std::mt19937_64& generator) const {
    std::vector<LoadSample> samples;
    for (int i = 0; i < poses; ++i) {
      const JointAngles angles = random_angles(robot, generator);
      for (const Eigen::Vector3d& force : kThreeLoads)
        samples.push_back(measured(angles, force, noise_m, generator));
    }
    return samples;
  }
};

// Share of the deflections at new poses that lie within 1.96 stated deviations of their prediction.
double coverage(const YieldingRobot& truth, const Identification& found, double noise_m,
                std::mt19937_64& generator) {
  constexpr int kNew = 40;
  int inside = 0;
  for (int i = 0; i < kNew; ++i) {
    const LoadSample sample = truth.measured(random_angles(truth.robot, generator),
                                             kThreeLoads[i % kThreeLoads.size()], noise_m, generator);
    const RobotPose pose = robot_pose(truth.robot, sample.angles);
    const Eigen::Vector3d point = pose.tool.translation();
    const Eigen::Vector3d deflection =
        compliance_at(pose, found.springs, found.compliance, point) * sample.force_n;
    const double length = deflection.norm();
    Eigen::VectorXd slope(found.springs.size());
    for (std::size_t k = 0; k < found.springs.size(); ++k) {
      const Eigen::Vector3d v = spring_axis(pose, found.springs[k]).displacement(point);
      slope[k] = v.dot(sample.force_n) * v.dot(deflection) / length;
    }
    const double variance = slope.dot(found.covariance * slope) + found.discrepancy.variance(length);
    inside += std::abs(length - sample.deflection_m.norm()) < 1.96 * std::sqrt(variance);
  }
  return static_cast<double>(inside) / kNew;
}

}  // namespace

TEST_CASE("deflections at new poses lie within the stated deviations, whatever else yields") {
  std::mt19937_64 generator(201);
  for (const auto& [poses, size, arm] :
       {std::tuple{12, 0.3, true}, {30, 0.3, true}, {30, 0.03, true}, {30, 0.3, false}, {20, 0.0, false}}) {
    double sum = 0;
    constexpr int kRuns = 40;
    for (int run = 0; run < kRuns; ++run) {
      const YieldingRobot truth(ElasticModel::kThreeAxis, size, arm, generator);
      const Identification found =
          identify_stiffness(truth.robot, truth.campaign(poses, 5e-6, generator), {});
      CHECK(found.model_error == (size > 0));
      sum += coverage(truth, found, 5e-6, generator) / kRuns;
    }
    // 1600 new poses, those of a run not independent: 95 % to 1 %.
    CHECK(sum > 0.92);
    CHECK(sum < 0.98);
  }
}

TEST_CASE("the model that the data support is chosen, and the simpler one where they cannot tell") {
  std::mt19937_64 generator(202);
  for (const ElasticModel model :
       {ElasticModel::kJointsOnly, ElasticModel::kBase, ElasticModel::kThreeAxis}) {
    int right = 0, simplest = 0;
    for (int run = 0; run < 40; ++run) {
      const YieldingRobot truth(model, 0.3, false, generator);
      const auto choice = [&](double noise_m) {
        IdentificationOptions options;
        options.model = std::nullopt;
        return identify_stiffness(truth.robot, truth.campaign(15, noise_m, generator), options);
      };
      right += choice(5e-6).model == model;
      simplest += choice(5e-3).model == ElasticModel::kJointsOnly;  // noise above all deflections
    }
    CHECK(right >= 38);
    CHECK(simplest >= 36);
  }
}

TEST_CASE("exact samples of joints alone are explained by joints alone") {
  std::mt19937_64 generator(203);
  const YieldingRobot truth(ElasticModel::kJointsOnly, 0, false, generator);
  IdentificationOptions options;
  options.model = std::nullopt;
  const Identification found = identify_stiffness(truth.robot, truth.campaign(12, 0, generator), options);
  CHECK(found.model == ElasticModel::kJointsOnly);
  CHECK_FALSE(found.model_error);
  CHECK(found.discrepancy.none());
  REQUIRE(found.models.trials.size() == 3);
  for (const ModelTrial& trial : found.models.trials) CHECK(trial.residual_rms_m < 1e-9);
}

TEST_CASE("rows that repeat a pose and a load do not shrink the deviations") {
  std::mt19937_64 generator(204);
  const YieldingRobot truth(ElasticModel::kThreeAxis, 0.02, true, generator);
  const std::vector<LoadSample> once = truth.campaign(20, 10e-6, generator);
  // The same rows again, and new measurements of the same poses and loads with little noise of their own.
  std::vector<LoadSample> copied = once, repeated;
  copied.insert(copied.end(), once.begin(), once.end());
  copied.insert(copied.end(), copied.begin(), copied.end());
  for (const LoadSample& sample : once) {
    for (int k = 0; k < 4; ++k) {
      repeated.push_back(sample);
      for (double& x : repeated.back().deflection_m) x += 1e-6 * numerics::unit_normal(generator);
    }
  }
  const Identification single = identify_stiffness(truth.robot, once, {});
  for (const auto& samples : {copied, repeated}) {
    const Identification found = identify_stiffness(truth.robot, samples, {});
    CHECK(found.model_error);
    for (int j = 0; j < 5; ++j)
      CHECK(std::sqrt(found.covariance(j, j)) > 0.6 * std::sqrt(single.covariance(j, j)));
  }
  // Repeats that scatter as the residuals do are as many measurements.
  std::vector<LoadSample> independent;
  const YieldingRobot rigid(ElasticModel::kJointsOnly, 0, false, generator);
  for (int i = 0; i < 10; ++i) {
    const JointAngles angles = random_angles(rigid.robot, generator);
    for (int k = 0; k < 4; ++k) {
      for (const Eigen::Vector3d& force : kThreeLoads)
        independent.push_back(rigid.measured(angles, force, 10e-6, generator));
    }
  }
  CHECK_FALSE(identify_stiffness(rigid.robot, independent, {}).model_error);
}

TEST_CASE("left-out groups are what leaving them out does, small groups and large ones") {
  std::mt19937_64 generator(205);
  const YieldingRobot truth(ElasticModel::kJointsOnly, 0, false, generator);
  const std::vector<LoadSample> samples = truth.campaign(12, 10e-6, generator);
  const auto springs = joint_springs();
  const std::array<bool, 3> xyz = {true, true, true};
  const ComplianceEquations equations = compliance_equations(truth.robot, springs, samples, xyz);
  const ComplianceFit fit = fit_compliances(equations, false);
  const SampleGroups poses = groups_by_pose(samples), blocks = groups_by_block(samples, poses);
  CHECK(poses.count == 12);
  CHECK(blocks.count == 10);
  SampleGroups halves;
  halves.count = 2;
  for (std::size_t s = 0; s < samples.size(); ++s) halves.of_sample.push_back(s < samples.size() / 2 ? 0 : 1);
  for (const SampleGroups& groups : {poses, blocks, halves}) {
    const LeftOut left = leave_out(fit, groups);
    for (int group = 0; group < groups.count; ++group) {
      std::vector<LoadSample> others;
      for (std::size_t s = 0; s < samples.size(); ++s) {
        if (groups.of_sample[s] != group) others.push_back(samples[s]);
      }
      const ComplianceEquations rest = compliance_equations(truth.robot, springs, others, xyz);
      const ComplianceFit without = fit_compliances(rest, false);
      for (Eigen::Index i = 0; i < equations.b.size(); ++i) {
        if (groups.of_sample[equations.sample[i]] != group) continue;
        const double predicted = equations.a.row(i).head<5>() * without.solution;
        CHECK(std::abs(equations.b[i] - predicted - left.error[i]) < 1e-15);
      }
    }
  }
}
