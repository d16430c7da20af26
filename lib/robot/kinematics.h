// Where the joints' axes, the flange and the tool are, and how they move with the joints.
#pragma once

#include "robot/robot.h"

namespace stablecut::robot {

using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// The robot at one set of angles, base frame, m.
struct RobotPose {
  Eigen::Matrix<double, 3, kJoints>
      axis;  ///< unit vectors, positive in the sense of growing turns (Robot::turn_rad)
  Eigen::Matrix<double, 3, kJoints> point;    ///< a point on each axis: the origin of its frame
  Eigen::Matrix<double, 3, kJoints> frame_x;  ///< unit vectors, the x axes of the joints' frames
  Eigen::Isometry3d flange;
  Eigen::Isometry3d tool;
};

/// Forward kinematics: T(i-1, i) = Rx(alpha) Tx(a) Rz(theta) Tz(d), with a, alpha of link i-1 [Yi2025, eq.
/// 1], from the robot's base on.
RobotPose robot_pose(const Robot& robot, const JointAngles& angles);

/// Jacobian of a point fixed to the last link (base frame, m): rows velocity (m/rad), then rotation
/// (rad/rad); column i is [z_i x (point - p_i); z_i] [Yi2025, eq. 4], [Whitney1972]. It belongs to the
/// joint's own turn, which is what its gearbox yields by: a coupled angle does not change it.
Matrix6d jacobian(const RobotPose& pose, const Eigen::Vector3d& point);

/// Its first three rows.
Eigen::Matrix<double, 3, kJoints> translational_jacobian(const RobotPose& pose, const Eigen::Vector3d& point);

/// The frame of joint j's link in the base frame: z along the axis by the table's sense, x as in the table.
Eigen::Isometry3d link_frame(const Robot& robot, const RobotPose& pose, int j);

/// The least singular value of the Jacobian at the tool point, lengths in m: 0 at a singular pose.
double singularity_margin(const RobotPose& pose);

/// Its square, the least eigenvalue of J J^T: a smooth function of where the tool is, also where the margin
/// is not (0, or the stretched arm, which it leaves like a square root). To 1e-15 of the largest singular
/// value's square.
double squared_singularity_margin(const RobotPose& pose);

/// True when the singularity margin is at least `margin`. Decided by a Cholesky factorization of J J^T -
/// margin^2, which costs a tenth of the singular values.
bool is_away_from_singularities(const RobotPose& pose, double margin);

/// Angle (rad, -pi..pi) by which the tool's x axis is turned about the tool's z axis from where it is nearest
/// to the base's x axis; where the tool axis is parallel to the base's x axis, nearest to its y axis.
double redundancy_angle(const Eigen::Isometry3d& tool);

/// The tool's frame (base frame, m) with its origin at `point` and its z axis along `axis` (length 1), at
/// that redundancy angle.
Eigen::Isometry3d tool_frame(const Eigen::Vector3d& point, const Eigen::Vector3d& axis,
                             double redundancy_rad);

}  // namespace stablecut::robot
