// A serial robot with six turning joints, in modified Denavit-Hartenberg form [Craig2018], [Yi2025, eq. 1].
// README.md, "Robot", has the notation.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

namespace stablecut::robot {

inline constexpr int kJoints = 6;

/// Controller angles A1..A6, rad. Not DH angles: theta = sign * angle + offset.
using JointAngles = Eigen::Matrix<double, kJoints, 1>;

struct Joint {
  std::string name;
  double a_m = 0;         ///< of link i-1: distance between axes i-1 and i, along x of frame i-1
  double d_m = 0;         ///< along axis i
  double theta_sign = 1;  ///< +1 or -1
  double theta_offset_rad = 0;
  double min_rad = -2 * std::numbers::pi;  ///< of the controller angle; limits are finite
  double max_rad = 2 * std::numbers::pi;

  /// Of link i-1: the turn from axis i-1 to axis i about x of frame i-1. A sine or cosine within 1e-14 of a
  /// whole number is taken as that number.
  void set_alpha(double rad);
  double alpha_rad() const { return alpha_rad_; }
  double cos_alpha() const { return cos_alpha_; }
  double sin_alpha() const { return sin_alpha_; }

  double theta_of(double angle_rad) const { return theta_sign * angle_rad + theta_offset_rad; }
  double middle_rad() const { return 0.5 * (min_rad + max_rad); }
  double half_range_rad() const { return 0.5 * (max_rad - min_rad); }
  /// Distance to the nearer limit; negative outside.
  double margin_rad(double angle_rad) const { return half_range_rad() - std::abs(angle_rad - middle_rad()); }

 private:
  double alpha_rad_ = 0, cos_alpha_ = 1, sin_alpha_ = 0;
};

struct Robot {
  std::array<Joint, kJoints> joints;
  Eigen::Isometry3d flange = Eigen::Isometry3d::Identity();  ///< in frame 6
  /// In the flange frame; its origin is the tool point and its z axis the tool axis.
  Eigen::Isometry3d tool = Eigen::Isometry3d::Identity();

  Eigen::Isometry3d tool_in_frame6() const { return flange * tool; }
};

/// Each angle moved by whole turns to its copy nearest the middle of its range, which is the copy with the
/// largest margin to the limits.
JointAngles most_central_copies(const Robot& robot, const JointAngles& angles);

/// The least distance of any joint to its nearer limit, rad; negative outside.
double limit_margin_rad(const Robot& robot, const JointAngles& angles);

/// How the tool point and the tool axis lie to axis 6.
struct ToolAlignment {
  bool point_on_axis = false;  ///< the tool point lies on axis 6: joint 6 cannot move it
  bool axis_parallel = false;  ///< the tool axis is parallel to axis 6: joint 6 turns the tool about it
  bool coaxial() const { return point_on_axis && axis_parallel; }
};

/// Both within 1e-9 (m, and the sine of an angle).
ToolAlignment tool_alignment(const Robot& robot);

}  // namespace stablecut::robot
