// The elastic elements of a robot: a spring for each joint and, in richer models, for its bearings and for
// the foundation. README.md, "Elasticity".
#pragma once

#include <Eigen/Core>
#include <vector>

#include "robot/kinematics.h"

namespace stablecut::robot {

/// An element that yields in one way, by its compliance times the load that it carries.
struct Spring {
  enum class Kind {
    kJoint,    ///< a turn about the joint's own axis, rad/(N m)
    kBearing,  ///< a turn about the x or y axis of the joint's frame, rad/(N m)
    kBase,     ///< the foundation moves along x, y or z of the base frame, m/N
  };
  Kind kind = Kind::kJoint;
  int joint = 0;  ///< index; of kJoint and kBearing
  int axis = 2;   ///< 0, 1, 2: x, y, z

  bool operator==(const Spring& other) const = default;
};

/// Nested: each model has the springs of those before it.
enum class ElasticModel {
  kJointsOnly,  ///< a spring for each joint
  kBase,        ///< and the foundation
  kThreeAxis,   ///< and the bearings: three springs a joint
};

/// The six joints' springs.
std::vector<Spring> joint_springs();

/// The springs of a model, the six joints' first. A spring whose effect on the tool's compliance is in every
/// pose a mixture of those before it is left out: two axes that always coincide are one spring.
std::vector<Spring> springs_of(const Robot& robot, ElasticModel model);

/// How a spring moves what is behind it: a unit turn about `direction` through `point`, or a unit
/// displacement along `direction`. Base frame, m.
struct SpringAxis {
  Eigen::Vector3d direction, point;
  bool turns = true;

  /// Displacement of a point per unit of the spring's coordinate.
  Eigen::Vector3d displacement(const Eigen::Vector3d& at) const {
    return turns ? direction.cross(at - point) : direction;
  }
  /// Rotation per unit.
  Eigen::Vector3d rotation() const { return turns ? direction : Eigen::Vector3d::Zero(); }
  /// What a force at a point and a moment load the spring with: N m or N.
  double load(const Eigen::Vector3d& force, const Eigen::Vector3d& at, const Eigen::Vector3d& moment) const {
    return displacement(at).dot(force) + rotation().dot(moment);
  }
};

SpringAxis spring_axis(const RobotPose& pose, const Spring& spring);

/// What the weight of the links behind a spring, those whose mass is known, loads it with: N m or N. Weight
/// acts along -z of the base frame.
double weight_load(const Robot& robot, const RobotPose& pose, const Spring& spring);

/// Compliance of a point on the last link, m/N, base frame: the sum of c_k v_k v_k^T over the springs, with
/// v_k = displacement(point).
Eigen::Matrix3d compliance_at(const RobotPose& pose, const std::vector<Spring>& springs,
                              const Eigen::VectorXd& compliance, const Eigen::Vector3d& point);

}  // namespace stablecut::robot
