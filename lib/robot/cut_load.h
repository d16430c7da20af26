// The forces of a cut on the tool, and what of the deflection under them shows on the part. README.md, "The
// deflection under a cut".
#pragma once

#include <Eigen/Core>
#include <vector>

namespace stablecut::robot {

/// In the cut's frame (cut_frame()), N, on the tool.
struct CutLoad {
  double depth_m = 0;          ///< along the tool axis, that the forces belong to
  Eigen::Vector3d mean_n;      ///< over the turn
  Eigen::Matrix3Xd turning_n;  ///< as the cutter turns: a closed curve whose convex hull holds the mean

  /// A wall that the cut leaves, on the side of the frame's +Y (left of the feed) or of its -Y.
  struct Wall {
    bool left = true;
    Eigen::Matrix3Xd leaving_n;  ///< while teeth touch it; none where that is not known
  };
  std::vector<Wall> walls;

  double peak_n() const { return turning_n.colwise().norm().maxCoeff(); }
};

/// Whether a feed has a direction across the tool axis (length 1).
bool across_tool(const Eigen::Vector3d& feed, const Eigen::Vector3d& tool_axis);

/// The cut's frame, as columns in the frame of the arguments: X along the feed as far as it runs across the
/// tool axis, Y to its left seen from the spindle, Z from the tip to the spindle, against the tool axis
/// (length 1). Throws InvalidArgument unless across_tool().
Eigen::Matrix3d cut_frame(const Eigen::Vector3d& feed, const Eigen::Vector3d& tool_axis);

/// The largest size of the component `yields` * f over the forces f, m: `yields` is a row of the compliance.
/// With `smoothing` 1/P the root of power P of the sum of the P-th powers instead, which has no kinks and is
/// at most n^(1/P) times as large, n the number of forces that nearly tie.
double largest_component(const Eigen::RowVector3d& yields, const Eigen::Matrix3Xd& forces_n,
                         double smoothing = 0);
/// The same of the length of compliance * f, and the force that has the largest.
struct LargestOfTurn {
  double length = 0;
  Eigen::Index at = 0;  ///< column
};
LargestOfTurn largest_length(const Eigen::Matrix3d& compliance, const Eigen::Matrix3Xd& forces_n,
                             double smoothing = 0);

}  // namespace stablecut::robot
