// The path of a tool point through a workpiece, and the frames along it that depend on the path alone.
// README.md, "Paths".
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

namespace stablecut::robot {

/// Base frame, SI.
struct ToolPathPoint {
  Eigen::Vector3d position;             ///< of the tool point
  Eigen::Vector3d axis;                 ///< direction of the tool's z, length 1
  std::optional<Eigen::Vector3d> feed;  ///< direction of the feed; not given: that of the path
  double speed = 0;                     ///< m/s, above 0: of the straight move that leads here
};
using ToolPath = std::vector<ToolPathPoint>;

/// The path of a workpiece that is moved so.
ToolPath moved(ToolPath path, const Eigen::Isometry3d& move);

/// What follows from a path whatever robot drives it. A "turn" of the tool is about its own axis, counted
/// from a frame that is carried along the path by the least rotation from one axis to the next: a turn that
/// stays the same is no turning of the tool about its axis.
struct PathFrames {
  std::vector<Eigen::Matrix3d> tool;  ///< the tool's axes at turn 0 (columns), base frame
  /// redundancy_angle() at turn 0, rad; that of turn t is this plus t. At the first point 0.
  std::vector<double> redundancy;
  /// Columns: feed square to the tool axis, axis x feed, axis. Where the feed runs along the axis or
  /// nothing moves it is that of the point before.
  std::vector<Eigen::Matrix3d> feed;
  std::vector<double> distance;  ///< m, of the move that leads to the point; 0 for the first
  std::vector<double> time;      ///< s, the same; 0 also for moves without distance
};

PathFrames path_frames(const ToolPath& path);

/// The tool's frame (base frame, m) at a point of the path, at that turn.
Eigen::Isometry3d tool_frame(const ToolPath& path, const PathFrames& frames, std::size_t point, double turn);

}  // namespace stablecut::robot
