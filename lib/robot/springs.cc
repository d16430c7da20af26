#include "robot/springs.h"

#include <random>

#include "base/units.h"
#include "numerics/random.h"

namespace stablecut::robot {
namespace {

constexpr int kTrialPoses = 24;       // at which springs are compared
constexpr double kSameSpring = 1e-9;  // of its length: what the springs before leave of a column

std::vector<Spring> all_springs(ElasticModel model) {
  std::vector<Spring> springs = joint_springs();
  for (int axis = 0; axis < 3 && model != ElasticModel::kJointsOnly; ++axis)
    springs.push_back({Spring::Kind::kBase, 0, axis});
  for (int j = 0; j < kJoints && model == ElasticModel::kThreeAxis; ++j) {
    for (int axis = 0; axis < 2; ++axis) springs.push_back({Spring::Kind::kBearing, j, axis});
  }
  return springs;
}

// All 21 entries of t t^T at every pose, t the spring's twist at the flange: what it adds to the compliance
// of the flange, to forces and moments.
Eigen::VectorXd effect(const std::vector<RobotPose>& poses, const Spring& spring) {
  Eigen::VectorXd column(21 * poses.size());
  Eigen::Index at = 0;
  for (const RobotPose& pose : poses) {
    const SpringAxis axis = spring_axis(pose, spring);
    Eigen::Matrix<double, 6, 1> twist;
    twist << axis.displacement(pose.flange.translation()), axis.rotation();
    for (int i = 0; i < 6; ++i) {
      for (int k = 0; k <= i; ++k) column[at++] = twist[i] * twist[k];
    }
  }
  return column;
}

}  // namespace

SpringAxis spring_axis(const RobotPose& pose, const Spring& spring) {
  if (spring.kind == Spring::Kind::kBase)
    return {Eigen::Vector3d::Unit(spring.axis), Eigen::Vector3d::Zero(), false};
  const Eigen::Vector3d z = pose.axis.col(spring.joint), x = pose.frame_x.col(spring.joint);
  return {spring.axis == 2 ? z : spring.axis == 0 ? x : z.cross(x), pose.point.col(spring.joint), true};
}

std::vector<Spring> joint_springs() {
  std::vector<Spring> springs;
  for (int j = 0; j < kJoints; ++j) springs.push_back({Spring::Kind::kJoint, j, 2});
  return springs;
}

std::vector<Spring> springs_of(const Robot& robot, ElasticModel model) {
  const std::vector<Spring> all = all_springs(model);
  if (model == ElasticModel::kJointsOnly) return all;
  std::mt19937_64 generator(1);
  std::vector<RobotPose> poses;
  for (int i = 0; i < kTrialPoses; ++i) {
    JointAngles angles;
    for (double& angle : angles) angle = numerics::uniform(generator, -kPi, kPi);
    poses.push_back(robot_pose(robot, angles));
  }
  std::vector<Spring> springs;
  std::vector<Eigen::VectorXd> basis;
  for (const Spring& spring : all) {
    Eigen::VectorXd left = effect(poses, spring).normalized();
    for (int pass = 0; pass < 2; ++pass) {
      for (const Eigen::VectorXd& known : basis) left -= known.dot(left) * known;
    }
    // A joint is kept whatever it looks like: the document has a place for each.
    const bool of_its_own = left.norm() > kSameSpring;
    if (of_its_own) basis.push_back(left.normalized());
    if (of_its_own || spring.kind == Spring::Kind::kJoint) springs.push_back(spring);
  }
  return springs;
}

double weight_load(const Robot& robot, const RobotPose& pose, const Spring& spring) {
  const SpringAxis axis = spring_axis(pose, spring);
  double load = 0;
  for (int j = spring.kind == Spring::Kind::kBase ? 0 : spring.joint; j < kJoints; ++j) {
    const auto& mass = robot.joints[j].mass;
    if (!mass) continue;
    load += axis.load({0, 0, -mass->mass_kg * kStandardGravity}, link_frame(robot, pose, j) * mass->center_m,
                      Eigen::Vector3d::Zero());
  }
  return load;
}

Eigen::Matrix3d compliance_at(const RobotPose& pose, const std::vector<Spring>& springs,
                              const Eigen::VectorXd& compliance, const Eigen::Vector3d& point) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (std::size_t k = 0; k < springs.size(); ++k) {
    const Eigen::Vector3d v = spring_axis(pose, springs[k]).displacement(point);
    sum += compliance[k] * v * v.transpose();
  }
  return sum;
}

}  // namespace stablecut::robot
