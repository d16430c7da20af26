#include "robot/pose_families.h"

#include <algorithm>
#include <cmath>

#include "base/units.h"
#include "robot/keep_out.h"

namespace stablecut::robot {
namespace {

constexpr double kSameAngle = 1e-4;        // rad
constexpr double kBoundRounding = 1e-9;    // m and rad by which a family may leave intervals and limits
constexpr double kZeroCoordinate = 1e-12;  // m: a coordinate below is 0
constexpr double kAlongAxis = 1e-12;       // sine below which a direction lies along axis 1
constexpr double kFamilyStep = kPi / 720;  // rad
constexpr int kBisections = 50;            // of the last step

bool inside(const Range& range, double value) {
  return value >= range.from - kBoundRounding && value <= range.to + kBoundRounding;
}

// The pose with the place in the task's space to which its angles bring the tool; nothing outside the task's
// intervals and limits.
std::optional<FoundPose> with_place_of_tool(const PoseScanner& scanner, FoundPose pose) {
  const PoseTask& task = scanner.task();
  if (limit_margin_rad(scanner.robot(), pose.angles) < task.limit_margin_rad - kBoundRounding)
    return std::nullopt;
  const RobotPose there = robot_pose(scanner.robot(), pose.angles);
  if (keep_out_margin_m(scanner.robot(), there) < -kBoundRounding) return std::nullopt;
  const Eigen::Isometry3d& tool = there.tool;
  const Eigen::Vector3d offset = tool.translation() - task.plane.origin;
  const auto rounded = [](double value) { return std::abs(value) < kZeroCoordinate ? 0 : value; };
  pose.at.x = rounded(offset.dot(task.plane.x_axis));
  pose.at.y = rounded(offset.dot(task.plane.y_axis));
  // Of all copies of the turn by whole turns, the one nearest the middle of the interval.
  const double turn = redundancy_angle(tool), middle = 0.5 * (task.redundancy.from + task.redundancy.to);
  pose.at.redundancy = task.full_turn() ? turn : turn + kTwoPi * std::nearbyint((middle - turn) / kTwoPi);
  if (!task.full_turn() && !inside(task.redundancy, pose.at.redundancy)) return std::nullopt;
  if (!inside(task.x, pose.at.x) || !inside(task.y, pose.at.y)) return std::nullopt;
  return pose;
}

// The angles with one joint's angle changed, and all other joints turned as they were.
JointAngles with_angle(const Robot& robot, const JointAngles& angles, int joint, double angle) {
  JointAngles turns = joint_turns(robot, angles);
  turns[joint] += angle - angles[joint];
  JointAngles result = angles_of_turns(robot, turns);
  result[joint] = angle;
  return result;
}

// The pose with one joint turned to `angle`, if the task's intervals and limits allow it. Where the
// redundancy cannot matter but is bounded, joint 6 undoes what a turn of the base does to the tool.
std::optional<FoundPose> with_joint_at(const PoseScanner& scanner, const FoundPose& found, int joint,
                                       double angle) {
  FoundPose pose = found;
  pose.angles = with_angle(scanner.robot(), found.angles, joint, angle);
  if (joint == 0 && !scanner.redundancy_matters() && !scanner.task().full_turn()) {
    const double turn = redundancy_angle(robot_pose(scanner.robot(), pose.angles).tool);
    pose.angles[5] += scanner.turn_sense() * std::remainder(found.at.redundancy - turn, kTwoPi);
    pose.angles =
        with_angle(scanner.robot(), most_central_copies(scanner.robot(), pose.angles), joint, angle);
  }
  auto result = with_place_of_tool(scanner, pose);
  if (result && scanner.task().redundancy.is_point()) result->at.redundancy = found.at.redundancy;
  return result;
}

}  // namespace

Symmetry symmetry_of(const PoseScanner& scanner) {
  const PoseTask& task = scanner.task();
  const Robot& robot = scanner.robot();
  const Eigen::Vector3d axis1 =
      robot.base.linear() * Eigen::Vector3d(0, -robot.joints[0].sin_alpha(), robot.joints[0].cos_alpha());
  const auto along_axis1 = [&](const Eigen::Vector3d& v) {
    return v.cross(axis1).norm() <= kAlongAxis * v.norm();
  };
  Symmetry symmetry;
  symmetry.tool_turn = !scanner.redundancy_matters() && !task.redundancy.is_point();
  const bool load_turns = !task.stiffness.index->needs_force || task.stiffness.force_in_tool ||
                          (!task.stiffness.cut && along_axis1(*task.stiffness.force_n));
  symmetry.base_turn = load_turns && scanner.springs().base_alike_about_axis1() &&
                       along_axis1(task.tool_axis) &&
                       along_axis1(task.plane.x_axis.cross(task.plane.y_axis)) && !task.x.is_point() &&
                       !task.y.is_point() && (!task.redundancy.is_point() || !scanner.redundancy_matters());
  return symmetry;
}

// In steps to either side until one is not allowed, then by bisection.
PoseFamily family_of(const PoseScanner& scanner, const FoundPose& found, PoseFamily::Kind kind, int joint) {
  PoseFamily family{kind, found.angles[joint], found.angles[joint]};
  const AngleRange limits = scanner.robot().range(joint, found.angles);
  for (const double sense : {-1.0, 1.0}) {
    const double margin = scanner.task().limit_margin_rad;
    const double end = sense < 0 ? limits.min_rad + margin : limits.max_rad - margin;
    double good = found.angles[joint], bad = end;
    bool open = true;
    for (double next = good + sense * kFamilyStep; open && sense * (end - next) > 0;
         next += sense * kFamilyStep) {
      open = with_joint_at(scanner, found, joint, next).has_value();
      (open ? good : bad) = next;
    }
    if (open && with_joint_at(scanner, found, joint, end)) good = bad = end;
    for (int i = 0; i < kBisections && good != bad; ++i) {
      const double middle = 0.5 * (good + bad);
      (with_joint_at(scanner, found, joint, middle) ? good : bad) = middle;
    }
    (sense < 0 ? family.from_rad : family.to_rad) = good;
  }
  return family;
}

FoundPose central_member(const PoseScanner& scanner, FoundPose found, const Symmetry& symmetry) {
  for (const int j : {0, 5}) {
    if (!(j == 0 ? symmetry.base_turn : symmetry.tool_turn)) continue;
    const AngleRange range = scanner.robot().range(j, found.angles);
    const double margin = scanner.task().limit_margin_rad;
    const double central = std::clamp(0.0, range.min_rad + margin, range.max_rad - margin);
    if (const auto moved = with_joint_at(scanner, found, j, central)) found = *moved;
  }
  return found;
}

bool same_pose(const FoundPose& a, const FoundPose& b, const Symmetry& symmetry) {
  for (int j = 0; j < kJoints; ++j) {
    if ((j == 0 && symmetry.base_turn) || (j == 5 && symmetry.tool_turn)) continue;
    if (std::abs(std::remainder(a.angles[j] - b.angles[j], kTwoPi)) > kSameAngle) return false;
  }
  return true;
}

std::optional<FoundPose> flipped_wrist(const PoseScanner& scanner, const FoundPose& found) {
  FoundPose other = found;
  other.at.branch = (found.at.branch + kArms) % kBranches;
  const auto evaluation = scanner.evaluate(other.at);
  if (!evaluation) return std::nullopt;
  other.angles = evaluation->angles;
  if (limit_margin_rad(scanner.robot(), other.angles) < scanner.task().limit_margin_rad) return std::nullopt;
  const RobotPose pose = robot_pose(scanner.robot(), other.angles);
  if (keep_out_margin_m(scanner.robot(), pose) < -kBoundRounding) return std::nullopt;
  return other;
}

}  // namespace stablecut::robot
