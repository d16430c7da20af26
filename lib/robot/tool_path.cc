#include "robot/tool_path.h"

#include <cmath>

#include "robot/cut_load.h"
#include "robot/kinematics.h"

namespace stablecut::robot {
namespace {

constexpr double kStandstill = 1e-9;      // m: a move shorter than this only turns the tool
constexpr double kOpposite = -1 + 1e-12;  // cosine: axes that are turned over, with no least rotation

// The direction of the path at a point: of the move that leaves it, or at the end of the one that led there.
Eigen::Vector3d path_direction(const ToolPath& path, std::size_t i) {
  for (std::size_t next = i + 1; next < path.size(); ++next) {
    const Eigen::Vector3d move = path[next].position - path[i].position;
    if (move.norm() > kStandstill) return move.normalized();
  }
  for (std::size_t before = i; before-- > 0;) {
    const Eigen::Vector3d move = path[i].position - path[before].position;
    if (move.norm() > kStandstill) return move.normalized();
  }
  return Eigen::Vector3d::Zero();
}

Eigen::Matrix3d with_axis(const Eigen::Vector3d& x, const Eigen::Vector3d& axis) {
  const Eigen::Vector3d across = (x - axis.dot(x) * axis).normalized();
  return (Eigen::Matrix3d() << across, axis.cross(across), axis).finished();
}

// `x` of the frame before, turned as the least rotation turns `from` into `to`.
Eigen::Vector3d carried(const Eigen::Vector3d& x, const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  const double c = from.dot(to);
  if (c < kOpposite) return x;  // half a turn about x
  const Eigen::Vector3d v = from.cross(to);
  return x + v.cross(x) + v.cross(v.cross(x)) / (1 + c);
}

}  // namespace

ToolPath moved(ToolPath path, const Eigen::Isometry3d& move) {
  for (ToolPathPoint& point : path) {
    point.position = move * point.position;
    point.axis = move.linear() * point.axis;
    if (point.feed) point.feed = move.linear() * *point.feed;
  }
  return path;
}

PathFrames path_frames(const ToolPath& path) {
  PathFrames frames;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const Eigen::Vector3d& axis = path[i].axis;
    const bool first = i == 0;
    const Eigen::Matrix3d tool =
        first ? Eigen::Matrix3d(tool_frame(Eigen::Vector3d::Zero(), axis, 0).linear())
              : with_axis(carried(frames.tool.back().col(0), path[i - 1].axis, axis), axis);
    Eigen::Vector3d feed = path[i].feed.value_or(path_direction(path, i));
    if (!across_tool(feed, axis)) feed = first ? tool.col(0) : Eigen::Vector3d(frames.feed.back().col(0));
    if (!across_tool(feed, axis)) feed = tool.col(0);
    Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
    frame.linear() = tool;
    const double distance = first ? 0 : (path[i].position - path[i - 1].position).norm();
    frames.tool.push_back(tool);
    frames.redundancy.push_back(redundancy_angle(frame));
    frames.feed.push_back(with_axis(feed, axis));
    frames.distance.push_back(distance);
    frames.time.push_back(distance > kStandstill ? distance / path[i].speed : 0);
  }
  return frames;
}

Eigen::Isometry3d tool_frame(const ToolPath& path, const PathFrames& frames, std::size_t point, double turn) {
  const Eigen::Matrix3d& at = frames.tool[point];
  const double c = std::cos(turn), s = std::sin(turn);
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  frame.linear().col(0) = c * at.col(0) + s * at.col(1);
  frame.linear().col(1) = c * at.col(1) - s * at.col(0);
  frame.linear().col(2) = at.col(2);
  frame.translation() = path[point].position;
  return frame;
}

}  // namespace stablecut::robot
