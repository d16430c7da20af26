// Analytic inverse kinematics of robots with parallel shoulder and elbow axes and a spherical wrist.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "robot/arm_lanes.h"
#include "robot/robot.h"

namespace stablecut::robot {

/// A set of angles that reaches the target.
struct InverseSolution {
  JointAngles angles;           ///< the copies with the largest margin to the limits
  int branch = 0;               ///< 4 * flipped wrist + 2 * rear shoulder + elbow on the negative side
  double limit_margin_rad = 0;  ///< negative outside the limits
};

/// What the analytic solution asks of a robot's table. README.md, "Inverse kinematics".
enum class GeometryRule {
  kShoulderNotParallel,  ///< axes 1 and 2 are not parallel
  kElbowParallel,        ///< axes 2 and 3 are parallel
  kUpperArm,             ///< the upper arm (a of link 2) has a length
  kForearm,              ///< the wrist centre does not lie on axis 3
  kWristCentre,          ///< axes 4, 5 and 6 meet in one point
  kWristSquare,          ///< axis 5 is square to axis 4, and axis 6 to axis 5
};
enum class DhParameter { kA, kAlpha, kD };

/// What makes a table unfit for the analytic solution.
struct UnsupportedGeometry {
  int joint = 0;          ///< index
  DhParameter parameter;  ///< of that joint's row: it breaks the rule
  GeometryRule rule;
};

/// The first rule that the robot breaks, or nothing.
std::optional<UnsupportedGeometry> unsupported_geometry(const Robot& robot);

class InverseKinematics {
 public:
  /// Throws InvalidArgument where unsupported_geometry() finds something, or a joint has no finite limits.
  explicit InverseKinematics(const Robot& robot);

  /// All branches that reach the tool frame (base frame, m), inside the limits or not, without repeats where
  /// two coincide. Where the target leaves joint 1 free (wrist centre on axis 1) or joint 4 (axes 4 and 6 in
  /// line), that joint turns by its angle in `free`, by default 0 or what is nearest to 0 inside the limits;
  /// with the wrist centre on axis 2, joint 2 gets theta = 0.
  std::vector<InverseSolution> solve(const Eigen::Isometry3d& tool) const;
  std::vector<InverseSolution> solve(const Eigen::Isometry3d& tool, const JointAngles& free) const;

  /// The same for the kernel's callers: frame 6 for a tool frame, and the constants.
  ArmTarget target_of(const Eigen::Isometry3d& tool) const;
  const ArmConstants& constants() const { return constants_; }
  /// From the base frame to the kernel's home frame.
  const Eigen::Isometry3d& home_from_base() const { return home_from_base_; }

 private:
  void set_free_angles(double angle1, double angle4);

  Eigen::Isometry3d frame6_from_tool_;
  Eigen::Isometry3d home_from_base_;
  ArmConstants constants_;
};

/// All copies of the angles by whole turns that lie inside the limits by at least `margin_rad`.
std::vector<JointAngles> copies_within_limits(const Robot& robot, const JointAngles& angles,
                                              double margin_rad);

}  // namespace stablecut::robot
