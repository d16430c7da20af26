#include "robot/pose_standing.h"

#include <Eigen/Geometry>
#include <cmath>

#include "base/units.h"

namespace stablecut::robot {
namespace {

constexpr double kStandsOn = 1e-6;  // rad, m, and of the singularity margin
constexpr double kMove = 0.05;      // m
constexpr double kTurn = 5 * kPi / 180;

bool at_end(const Range& range, double value) {
  return !range.is_point() && std::min(value - range.from, range.to - value) <= kStandsOn;
}

Eigen::Vector3d axis_of(const Plane& plane, int axis) {
  return axis == 0   ? plane.x_axis
         : axis == 1 ? plane.y_axis
                     : Eigen::Vector3d(plane.x_axis.cross(plane.y_axis));
}

}  // namespace

Standing standing_of(const PoseTask& task, const PoseReport& report, const PlanePoint& at) {
  Standing standing;
  for (int j = 0; j < kJoints; ++j) {
    if (report.joint_margin_rad[j] <= task.limit_margin_rad + kStandsOn) standing.joints.push_back(j);
  }
  standing.singularity = report.singularity_margin <= task.singularity_margin + kStandsOn;
  standing.keep_out = report.keep_out_margin_m <= kStandsOn;
  standing.x = at_end(task.x, at.x);
  standing.y = at_end(task.y, at.y);
  standing.redundancy = !task.full_turn() && at_end(task.redundancy, at.redundancy);
  return standing;
}

std::vector<PartMove> part_moves(const Robot& robot, const PoseTask& task, const FoundPose& found) {
  std::vector<PartMove> moves;
  for (const bool turn : {false, true}) {
    for (int axis = 0; axis < 3; ++axis) {
      for (const double sense : {1.0, -1.0}) {
        PartMove move{turn, axis, sense * (turn ? kTurn : kMove), {}};
        const Eigen::Vector3d along = axis_of(task.plane, axis);
        PoseTask there = task;
        there.plane.origin = task.plane.at(found.at.x, found.at.y);
        there.x = there.y = {0, 0, 1};
        if (turn) {
          const Eigen::Matrix3d turned = Eigen::AngleAxisd(move.amount, along).matrix();
          there.tool_axis = turned * task.tool_axis;
          if (there.stiffness.force_n && !task.stiffness.force_in_tool)
            there.stiffness.force_n = turned * *task.stiffness.force_n;
          there.stiffness.feed = turned * task.stiffness.feed;
        } else {
          there.plane.origin += move.amount * along;
        }
        try {
          move.score = search_poses(robot, there, 0, 1).best.score;
        } catch (const NoPose&) {
        }
        moves.push_back(move);
      }
    }
  }
  return moves;
}

}  // namespace stablecut::robot
