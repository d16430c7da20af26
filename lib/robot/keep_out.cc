#include "robot/keep_out.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace stablecut::robot {
namespace {

// A straight piece, base frame, m.
struct Segment {
  Eigen::Vector3d from, to;
};

double nearest_to_axis(const Segment& segment, const Eigen::Vector3d& axis, const Eigen::Vector3d& on_axis) {
  // Seen along the axis: the distance of a segment from a point.
  const auto across = [&](const Eigen::Vector3d& point) -> Eigen::Vector3d {
    const Eigen::Vector3d from_axis = point - on_axis;
    return from_axis - axis.dot(from_axis) * axis;
  };
  const Eigen::Vector3d from = across(segment.from), along = across(segment.to) - from;
  const double length2 = along.squaredNorm();
  const double nearest = length2 > 0 ? std::clamp(-from.dot(along) / length2, 0.0, 1.0) : 0;
  return (from + nearest * along).norm();
}

// How deep the segment reaches into a box: the largest distance of its points from the nearest face, a
// concave function along it that is the least of six straight lines, and largest where two of them cross or
// at an end.
double depth_in_box(const Segment& segment, const Box& box) {
  const Eigen::Vector3d along = segment.to - segment.from;
  std::array<double, 6> at_begin, slope;
  for (int d = 0; d < 3; ++d) {
    at_begin[2 * d] = segment.from[d] - box.least_m[d];
    at_begin[2 * d + 1] = box.most_m[d] - segment.from[d];
    slope[2 * d] = along[d];
    slope[2 * d + 1] = -along[d];
  }
  const auto depth = [&](double t) {
    double least = at_begin[0] + t * slope[0];
    for (int i = 1; i < 6; ++i) least = std::min(least, at_begin[i] + t * slope[i]);
    return least;
  };
  double deepest = std::max(depth(0), depth(1));
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < i; ++j) {
      const double t = (at_begin[j] - at_begin[i]) / (slope[i] - slope[j]);
      if (t > 0 && t < 1) deepest = std::max(deepest, depth(t));
    }
  }
  return std::max(deepest, 0.0);
}

// The square of the distance from a box is convex along the segment, and a parabola between the points where
// the segment passes the planes of the faces.
double nearest_to_box(const Segment& segment, const Box& box) {
  const Eigen::Vector3d along = segment.to - segment.from;
  std::vector<double> ends{0, 1};
  for (int d = 0; d < 3; ++d) {
    for (const double face : {box.least_m[d], box.most_m[d]}) {
      const double t = (face - segment.from[d]) / along[d];
      if (t > 0 && t < 1) ends.push_back(t);
    }
  }
  std::sort(ends.begin(), ends.end());
  const auto outside = [&](double t) -> Eigen::Vector3d {
    const Eigen::Vector3d at = segment.from + t * along;
    return at - at.cwiseMax(box.least_m).cwiseMin(box.most_m);
  };
  double least = std::min(outside(0).squaredNorm(), outside(1).squaredNorm());
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    const double width = ends[i + 1] - ends[i];
    const Eigen::Vector3d from = outside(ends[i]), change = outside(ends[i + 1]) - from;
    const double size2 = change.squaredNorm();
    const double share = size2 > 0 ? std::clamp(-from.dot(change) / size2, 0.0, 1.0) : 0;
    least = std::min(least, outside(ends[i] + share * width).squaredNorm());
  }
  return least > 0 ? std::sqrt(least) : 0 - depth_in_box(segment, box);
}

// How far out of the z axis a capsule reaches in its frame.
double swept_radius(const Capsule& capsule) {
  return std::max(capsule.from_m.head<2>().norm(), capsule.to_m.head<2>().norm()) + capsule.radius_m;
}

}  // namespace

double keep_out_margin_m(const Robot& robot, const RobotPose& pose) {
  double least = std::numeric_limits<double>::infinity();
  const auto look = [&](const Segment& segment, double radius, bool column) {
    if (column && robot.keep_out_radius_m > 0) {
      const double distance = nearest_to_axis(segment, pose.axis.col(0), pose.point.col(0));
      least = std::min(least, distance - robot.keep_out_radius_m - radius);
    }
    if (robot.floor_m)
      least = std::min(least, std::min(segment.from.z(), segment.to.z()) - radius - *robot.floor_m);
    for (const Box& box : robot.keep_out_boxes)
      least = std::min(least, nearest_to_box(segment, box) - radius);
  };
  look({pose.flange.translation(), pose.tool.translation()}, 0, true);
  for (int j = 1; j < kJoints; ++j) {
    if (robot.joints[j].capsules.empty()) continue;
    const Eigen::Isometry3d frame = link_frame(robot, pose, j);
    for (const Capsule& capsule : robot.joints[j].capsules)
      look({frame * capsule.from_m, frame * capsule.to_m}, capsule.radius_m, j > 1);
  }
  return least;
}

double column_radius_m(const Robot& robot) {
  double radius = 0;
  // Axis 1 is z of a frame that is turned and moved from frame 0 by the first row of the table.
  const Joint& first = robot.joints[0];
  Eigen::Isometry3d to_axis1 = Eigen::Isometry3d::Identity();
  to_axis1.linear() = Eigen::AngleAxisd(first.alpha_rad(), Eigen::Vector3d::UnitX()).matrix();
  to_axis1.translation() = Eigen::Vector3d(first.a_m, 0, 0);
  const Eigen::Isometry3d from_axis1 = to_axis1.inverse();
  for (const Capsule& capsule : robot.base_capsules)
    radius = std::max(
        radius, swept_radius({from_axis1 * capsule.from_m, from_axis1 * capsule.to_m, capsule.radius_m}));
  for (const Capsule& capsule : first.capsules) radius = std::max(radius, swept_radius(capsule));
  const Joint& second = robot.joints[1];
  return std::max(radius, std::hypot(second.a_m, second.d_m * second.sin_alpha()));
}

}  // namespace stablecut::robot
