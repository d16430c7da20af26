// The question that a pose search answers: where the tool may stand, how it may be turned, and what counts as
// stiff.
#pragma once

#include <Eigen/Core>

#include "base/error.h"
#include "base/range.h"
#include "robot/joint_stiffness.h"
#include "robot/robot.h"
#include "robot/stiffness_index.h"

namespace stablecut::robot {

/// A plane in the base frame (m): the point origin + u x_axis + v y_axis, axes of length 1 at right angles.
struct Plane {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Vector3d x_axis = Eigen::Vector3d::UnitX();
  Eigen::Vector3d y_axis = Eigen::Vector3d::UnitY();

  Eigen::Vector3d at(double u, double v) const { return origin + u * x_axis + v * y_axis; }
};

struct PoseTask {
  Plane plane;
  Range x, y;                                             ///< of the tool point in the plane, m
  Eigen::Vector3d tool_axis = -Eigen::Vector3d::UnitZ();  ///< direction of the tool's z, base frame, length 1
  Range redundancy;  ///< turn about the tool axis, rad (redundancy_angle())
  StiffnessTask stiffness;
  Elasticity elasticity;
  double limit_margin_rad = 0;    ///< least distance to keep from every joint limit
  double singularity_margin = 0;  ///< least singularity_margin() to keep

  /// True when the redundancy interval stands for the full turn: what it leaves out is at most one of its
  /// steps and at most 5 degrees.
  bool full_turn() const;
};

/// A point of the search space.
struct PlanePoint {
  double x = 0, y = 0;    ///< in the plane, m
  double redundancy = 0;  ///< rad
  int branch = 0;
};

/// A pose found in that space.
struct FoundPose {
  PlanePoint at;
  JointAngles angles;  ///< controller angles, rad
  double score = 0;    ///< of the task's index, SI units
};

/// What keeps a search from finding any pose.
struct Obstacle {
  enum class Kind {
    kOutOfReach,   ///< no point of the plane is within the arm's reach with this tool axis
    kJointLimit,   ///< every pose violates a joint limit or its margin
    kSingularity,  ///< every pose that the limits allow is nearer to a singularity than the margin
    kKeepOut,      ///< and what is not brings tool or links into what they keep out of
  };
  Kind kind = Kind::kOutOfReach;
  /// Of kJointLimit: where the limits are missed by the least, the joint (index) that misses them and its
  /// distance to the limit, negative outside.
  int joint = 0;
  double margin_rad = 0;
};

/// A search without an answer, and why.
class NoPose : public NoAnswer {
 public:
  explicit NoPose(const Obstacle& obstacle) : NoAnswer("no reachable pose"), obstacle_(obstacle) {}
  const Obstacle& obstacle() const { return obstacle_; }

 private:
  Obstacle obstacle_;
};

/// Bounds in the plane's coordinates (m) of what the tool point can reach with the tool axis as it is, limits
/// aside. They enclose what can be reached and may be wider. Throws NoPose when the plane is out of reach.
struct PlaneReach {
  Range x, y;
};
PlaneReach plane_reach(const Robot& robot, const Plane& plane, const Eigen::Vector3d& tool_axis);

}  // namespace stablecut::robot
