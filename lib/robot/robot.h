// A serial robot with six turning joints, in modified Denavit-Hartenberg form [Craig2018], [Yi2025, eq. 1].
// README.md, "Robot", has the notation.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

namespace stablecut::robot {

inline constexpr int kJoints = 6;

/// Controller angles A1..A6, rad. Not DH angles: theta = sign * (angle + ratio * followed angle) + offset.
using JointAngles = Eigen::Matrix<double, kJoints, 1>;

/// What a controller angle may be, rad.
struct AngleRange {
  double min_rad, max_rad;

  double middle_rad() const { return 0.5 * (min_rad + max_rad); }
  double half_range_rad() const { return 0.5 * (max_rad - min_rad); }
  /// Distance to the nearer end; negative outside.
  double margin_rad(double angle_rad) const { return half_range_rad() - std::abs(angle_rad - middle_rad()); }
};

/// A controller angle that is not counted from the link before: the joint turns by angle + ratio * the
/// controller angle of a joint before it. Axis 3 of many robots is measured against the horizontal.
struct Coupling {
  int follows = 0;  ///< index of that joint, below the joint's own
  double ratio = 1;
};

/// All points within `radius_m` of the straight line between two points.
struct Capsule {
  Eigen::Vector3d from_m, to_m;
  double radius_m = 0;
};

/// A box with edges along the axes of the base frame, m.
struct Box {
  Eigen::Vector3d least_m, most_m;
};

struct LinkMass {
  double mass_kg = 0;
  Eigen::Vector3d center_m;  ///< centre of mass
};

/// A joint and the link that it moves. What belongs to the link is in frame i, which moves with it.
struct Joint {
  std::string name;
  double a_m = 0;         ///< of link i-1: distance between axes i-1 and i, along x of frame i-1
  double d_m = 0;         ///< along axis i
  double theta_sign = 1;  ///< +1 or -1
  double theta_offset_rad = 0;
  double min_rad = -2 * std::numbers::pi;  ///< of the controller angle; limits are finite
  double max_rad = 2 * std::numbers::pi;
  std::optional<Coupling> coupling;
  /// Of angle + ratio * followed angle, where the joint is coupled: what its mechanics allow.
  double coupled_min_rad = -std::numeric_limits<double>::infinity();
  double coupled_max_rad = std::numeric_limits<double>::infinity();
  std::optional<double> max_speed;  ///< rad/s, of the controller angle
  std::optional<LinkMass> mass;     ///< of the link
  std::vector<Capsule> capsules;    ///< that enclose the link, for keep_out_margin_m()

  /// Of link i-1: the turn from axis i-1 to axis i about x of frame i-1. A sine or cosine within 1e-14 of a
  /// whole number is taken as that number.
  void set_alpha(double rad);
  double alpha_rad() const { return alpha_rad_; }
  double cos_alpha() const { return cos_alpha_; }
  double sin_alpha() const { return sin_alpha_; }

  double half_range_rad() const { return AngleRange{min_rad, max_rad}.half_range_rad(); }

 private:
  double alpha_rad_ = 0, cos_alpha_ = 1, sin_alpha_ = 0;
};

struct Robot {
  /// Frame 0 of the table in the base frame, in which positions, directions and forces are given.
  Eigen::Isometry3d base = Eigen::Isometry3d::Identity();
  std::array<Joint, kJoints> joints;
  Eigen::Isometry3d flange = Eigen::Isometry3d::Identity();  ///< in frame 6
  /// In the flange frame; its origin is the tool point and its z axis the tool axis.
  Eigen::Isometry3d tool = Eigen::Isometry3d::Identity();

  std::vector<Capsule> base_capsules;  ///< of what does not move, frame 0
  // What keep_out_margin_m() looks at.
  double keep_out_radius_m = 0;     ///< of a cylinder round axis 1, without ends; 0: none
  std::optional<double> floor_m;    ///< z in the base frame below which nothing may be
  std::vector<Box> keep_out_boxes;  ///< base frame

  /// Whether there is anything to keep out of.
  bool keeps_out() const { return keep_out_radius_m > 0 || floor_m || !keep_out_boxes.empty(); }

  Eigen::Isometry3d tool_in_frame6() const { return flange * tool; }
  /// By how much joint j turns: its controller angle, with what a coupling adds to it.
  double turn_rad(int j, const JointAngles& angles) const;
  /// What the controller angle of joint j may be while the joint that it follows stands as in `angles`. Empty
  /// (the end before the beginning) where its coupled range leaves nothing.
  AngleRange range(int j, const JointAngles& angles) const;
};

/// theta_i = sign_i * turn_i + offset_i.
JointAngles joint_turns(const Robot& robot, const JointAngles& angles);
/// The controller angles that turn the joints so.
JointAngles angles_of_turns(const Robot& robot, const JointAngles& turns);

/// Each joint moved by whole turns to the copy of its angle nearest the middle of its range, which is the
/// copy with the largest margin to the limits.
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
