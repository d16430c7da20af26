#include "robot/keep_out.h"

#include <algorithm>
#include <limits>

namespace stablecut::robot {

double keep_out_margin_m(const Robot& robot, const RobotPose& pose) {
  if (!(robot.keep_out_radius_m > 0)) return std::numeric_limits<double>::infinity();
  // Seen along the axis: the distance of a segment from a point.
  const Eigen::Vector3d axis = pose.axis.col(0);
  const auto across = [&](const Eigen::Vector3d& point) -> Eigen::Vector3d {
    const Eigen::Vector3d from_axis = point - pose.point.col(0);
    return from_axis - axis.dot(from_axis) * axis;
  };
  const Eigen::Vector3d from = across(pose.flange.translation()),
                        along = across(pose.tool.translation()) - from;
  const double length2 = along.squaredNorm();
  const double nearest = length2 > 0 ? std::clamp(-from.dot(along) / length2, 0.0, 1.0) : 0;
  return (from + nearest * along).norm() - robot.keep_out_radius_m;
}

}  // namespace stablecut::robot
