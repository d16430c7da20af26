#include "robot/kinematics.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <cmath>

#include "numerics/elementary_lanes.h"

namespace stablecut::robot {
namespace {

constexpr double kAlongX = 1e-16;  // squared sine below which the tool axis is parallel to the base's x axis

// The tool's x and y axes at redundancy angle 0.
std::pair<Eigen::Vector3d, Eigen::Vector3d> reference_directions(const Eigen::Vector3d& axis) {
  Eigen::Vector3d x = Eigen::Vector3d::UnitX() - axis.x() * axis;
  if (x.squaredNorm() < kAlongX) x = Eigen::Vector3d::UnitY() - axis.y() * axis;
  x.normalize();
  return {x, axis.cross(x)};
}

}  // namespace

RobotPose robot_pose(const Robot& robot, const JointAngles& angles) {
  RobotPose pose;
  double theta[8] = {}, sine[8], cosine[8];
  for (int j = 0; j < kJoints; ++j) {
    theta[j] = robot.joints[j].theta_sign * robot.turn_rad(j, angles) + robot.joints[j].theta_offset_rad;
  }
  numerics::sines_and_cosines(theta, sine, cosine);
  Eigen::Matrix3d rotation = robot.base.linear();
  Eigen::Vector3d origin = robot.base.translation();
  for (int j = 0; j < kJoints; ++j) {
    const Joint& joint = robot.joints[j];
    const double ca = joint.cos_alpha(), sa = joint.sin_alpha();
    const double ct = cosine[j], st = sine[j];
    origin += joint.a_m * rotation.col(0);
    const Eigen::Vector3d y = ca * rotation.col(1) + sa * rotation.col(2);
    const Eigen::Vector3d z = ca * rotation.col(2) - sa * rotation.col(1);
    const Eigen::Vector3d x = rotation.col(0);
    rotation.col(0) = ct * x + st * y;
    rotation.col(1) = ct * y - st * x;
    rotation.col(2) = z;
    origin += joint.d_m * z;
    pose.axis.col(j) = joint.theta_sign * z;
    pose.point.col(j) = origin;
    pose.frame_x.col(j) = rotation.col(0);
  }
  Eigen::Isometry3d frame6 = Eigen::Isometry3d::Identity();
  frame6.linear() = rotation;
  frame6.translation() = origin;
  pose.flange = frame6 * robot.flange;
  pose.tool = pose.flange * robot.tool;
  return pose;
}

Eigen::Matrix<double, 3, kJoints> translational_jacobian(const RobotPose& pose,
                                                         const Eigen::Vector3d& point) {
  Eigen::Matrix<double, 3, kJoints> columns;
  for (int j = 0; j < kJoints; ++j) columns.col(j) = pose.axis.col(j).cross(point - pose.point.col(j));
  return columns;
}

Matrix6d jacobian(const RobotPose& pose, const Eigen::Vector3d& point) {
  Matrix6d result;
  result.topRows<3>() = translational_jacobian(pose, point);
  result.bottomRows<3>() = pose.axis;
  return result;
}

Eigen::Isometry3d link_frame(const Robot& robot, const RobotPose& pose, int j) {
  const Eigen::Vector3d z = robot.joints[j].theta_sign * pose.axis.col(j), x = pose.frame_x.col(j);
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  frame.linear() << x, z.cross(x), z;
  frame.translation() = pose.point.col(j);
  return frame;
}

double singularity_margin(const RobotPose& pose) {
  return Eigen::JacobiSVD<Matrix6d>(jacobian(pose, pose.tool.translation())).singularValues()[kJoints - 1];
}

double squared_singularity_margin(const RobotPose& pose) {
  const Matrix6d j = jacobian(pose, pose.tool.translation());
  return Eigen::SelfAdjointEigenSolver<Matrix6d>(j * j.transpose(), Eigen::EigenvaluesOnly).eigenvalues()[0];
}

bool is_away_from_singularities(const RobotPose& pose, double margin) {
  if (!(margin > 0)) return true;
  const Matrix6d j = jacobian(pose, pose.tool.translation());
  // Positive definite as long as the least eigenvalue of J J^T is above margin^2.
  const Eigen::LLT<Matrix6d> factor(Matrix6d(j * j.transpose()) - margin * margin * Matrix6d::Identity());
  return factor.info() == Eigen::Success;
}

double redundancy_angle(const Eigen::Isometry3d& tool) {
  const auto [x, y] = reference_directions(tool.linear().col(2));
  const Eigen::Vector3d tool_x = tool.linear().col(0);
  return std::atan2(tool_x.dot(y), tool_x.dot(x));
}

Eigen::Isometry3d tool_frame(const Eigen::Vector3d& point, const Eigen::Vector3d& axis,
                             double redundancy_rad) {
  const auto [x, y] = reference_directions(axis);
  const double c = std::cos(redundancy_rad), s = std::sin(redundancy_rad);
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  frame.linear().col(0) = c * x + s * y;
  frame.linear().col(1) = c * y - s * x;
  frame.linear().col(2) = axis;
  frame.translation() = point;
  return frame;
}

}  // namespace stablecut::robot
