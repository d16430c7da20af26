#include "robot/pose_task.h"

#include <algorithm>
#include <cmath>

#include "base/units.h"

namespace stablecut::robot {
namespace {

constexpr double kLargestGap = 5 * kPi / 180;  // rad that a full turn may leave out
constexpr double kGapRounding = 1e-9;          // rad

}  // namespace

bool PoseTask::full_turn() const {
  const double gap = kTwoPi - (redundancy.to - redundancy.from);
  return gap <= std::min(redundancy.step(), kLargestGap) + kGapRounding;
}

PlaneReach plane_reach(const Robot& robot, const Plane& plane, const Eigen::Vector3d& tool_axis) {
  // The wrist centre lies in a ball about the origin of frame 1, whose radius is the length of all links
  // after it. From the wrist centre the tool point lies a known distance along the tool axis, and a known
  // distance across it in a direction that depends on the redundancy angle.
  const auto& j = robot.joints;
  const double arm = std::abs(j[1].a_m) + std::abs(j[1].d_m) + std::abs(j[2].a_m) + std::abs(j[2].d_m) +
                     std::hypot(j[3].a_m, j[3].d_m) + std::hypot(j[4].a_m, j[4].d_m) + std::abs(j[5].a_m);
  Eigen::Isometry3d tool = robot.tool_in_frame6();
  tool.translation() += j[5].d_m * Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d from_wrist = tool.linear().transpose() * tool.translation();  // in the tool's frame
  const Eigen::Vector3d home =
      robot.base * Eigen::Vector3d(j[0].a_m, -j[0].d_m * j[0].sin_alpha(), j[0].d_m * j[0].cos_alpha());
  const Eigen::Vector3d centre = home + from_wrist.z() * tool_axis - plane.origin;
  const double radius = arm + from_wrist.head<2>().norm();
  const double distance = centre.dot(plane.x_axis.cross(plane.y_axis));
  if (std::abs(distance) > radius) throw NoPose({Obstacle::Kind::kOutOfReach});
  const double across = std::sqrt(radius * radius - distance * distance);
  const double x = centre.dot(plane.x_axis), y = centre.dot(plane.y_axis);
  return {{x - across, x + across, 2}, {y - across, y + across, 2}};
}

}  // namespace stablecut::robot
