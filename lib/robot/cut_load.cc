#include "robot/cut_load.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace stablecut::robot {
namespace {

constexpr double kAlongTool = 1e-6;  // sine: a feed nearer to the tool axis has no direction across it

// The largest of the sizes, or its smooth stand-in. The sizes are those of size(0), ..., size(count - 1).
template <typename Size>
LargestOfTurn largest_of(Eigen::Index count, double smoothing, const Size& size) {
  LargestOfTurn largest{-1, 0};
  for (Eigen::Index k = 0; k < count; ++k) {
    const double here = size(k);
    if (here > largest.length) largest = {here, k};
  }
  if (!(smoothing > 0) || !(largest.length > 0)) return largest;
  double sum = 0;
  for (Eigen::Index k = 0; k < count; ++k) sum += std::pow(size(k) / largest.length, 1 / smoothing);
  return {largest.length * std::pow(sum, smoothing), largest.at};
}

}  // namespace

bool across_tool(const Eigen::Vector3d& feed, const Eigen::Vector3d& tool_axis) {
  return tool_axis.cross(feed).norm() > kAlongTool * feed.norm();
}

Eigen::Matrix3d cut_frame(const Eigen::Vector3d& feed, const Eigen::Vector3d& tool_axis) {
  if (!across_tool(feed, tool_axis))
    throw InvalidArgument("feed: along the tool axis: expected a direction across it");
  const Eigen::Vector3d x = (feed - tool_axis.dot(feed) * tool_axis).normalized(), z = -tool_axis;
  return (Eigen::Matrix3d() << x, z.cross(x), z).finished();
}

double largest_component(const Eigen::RowVector3d& yields, const Eigen::Matrix3Xd& forces_n,
                         double smoothing) {
  return largest_of(forces_n.cols(), smoothing,
                    [&](Eigen::Index k) { return std::abs(yields * forces_n.col(k)); })
      .length;
}

LargestOfTurn largest_length(const Eigen::Matrix3d& compliance, const Eigen::Matrix3Xd& forces_n,
                             double smoothing) {
  return largest_of(forces_n.cols(), smoothing,
                    [&](Eigen::Index k) { return (compliance * forces_n.col(k)).norm(); });
}

}  // namespace stablecut::robot
