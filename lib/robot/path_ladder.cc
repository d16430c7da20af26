#include "robot/path_ladder.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/units.h"
#include "robot/keep_out.h"
#include "robot/singularity_lanes.h"

namespace stablecut::robot {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kLargestJointStep = kPi / 2;  // rad of a joint or the tool between neighbouring points
constexpr double kLimitRounding = 1e-9;        // rad: what is kept of a step's limit for rounding
constexpr double kIntervalRounding = 1e-9;     // rad
constexpr double kClosedGap = kPi / 180;       // rad that an interval of a full turn may leave out

AngleCopies copies_of(const Robot& robot, double margin) {
  AngleCopies copies;
  int product = 1;
  for (int j = 0; j < kJoints; ++j) {
    const AngleRange range{robot.joints[j].min_rad + margin, robot.joints[j].max_rad - margin};
    const double held = 1 + std::floor(std::max(0.0, 2 * range.half_range_rad()) / kTwoPi);
    const int most = std::min(AngleCopies::kMostEach, kMostCopies / product);
    copies.count[j] = static_cast<int>(std::min<double>(held, most));
    copies.least_rad[j] = held > most ? range.middle_rad() - kPi * most : range.min_rad;
    copies.stride[j] = product;
    product *= copies.count[j];
  }
  copies.combinations = product;
  for (int j = 0; j < kJoints; ++j) {
    copies.within[j].fill(0);
    for (int c = 0; c < product; ++c) {
      copies.turns[c][j] = c / copies.stride[j] % copies.count[j];
      for (int n = copies.turns[c][j] + 1; n <= AngleCopies::kMostEach; ++n)
        copies.within[j][n] |= std::uint32_t{1} << c;
    }
  }
  return copies;
}

// Whether another copy of a joint's angle moves what a coupled range asks for.
bool any_coupled_copies(const Robot& robot, const AngleCopies& copies) {
  for (int j = 0; j < kJoints; ++j) {
    const auto& coupling = robot.joints[j].coupling;
    if (coupling && (copies.count[j] > 1 || copies.count[coupling->follows] > 1)) return true;
  }
  return false;
}

bool full_turn(const std::optional<Range>& interval) {
  return !interval ||
         interval->to - interval->from >= kTwoPi - std::max(kClosedGap, interval->step()) - kIntervalRounding;
}

}  // namespace

double least_cost(const PointRungs& rungs) {
  double least = kInfinity;
  for (const BranchRungs& branch : rungs)
    least = std::min(least, *std::min_element(branch.cost.begin(), branch.cost.end()));
  return least;
}

StiffnessTask point_task(const PathTask& task, const PathFrames& frames, std::size_t point) {
  StiffnessTask at = task.stiffness;
  if (at.force_n && task.force_in_feed) {
    at.force_n = frames.feed[point] * *at.force_n;
    at.force_in_tool = false;
  }
  at.feed = frames.feed[point].col(0);
  return at;
}

PathModel::PathModel(const Robot& robot, const PathTask& task)
    : robot_(robot),
      task_(task),
      inverse_(robot),
      springs_(arm_springs(robot, task.elasticity, inverse_)),
      frames_(path_frames(task.path)),
      copies_(copies_of(robot, task.limit_margin_rad)),
      coupled_copies_(any_coupled_copies(robot, copies_)) {
  if (task.path.empty()) throw InvalidArgument("path: empty: expected points");
  check_force(task.stiffness);
  const auto to_home = inverse_.home_from_base().linear();
  for (std::size_t i = 0; i < size(); ++i) {
    const StiffnessTask at = point_task(task, frames_, i);
    load_.push_back(at.force_n && at.force_in_tool ? at.load(*at.force_n)
                                                   : turned(load_in_base(at, frames_.tool[i]), to_home));
    home_point_.push_back(inverse_.home_from_base() * task.path[i].position);
  }
}

bool PathModel::in_interval(std::size_t point, double turn) const {
  if (full_turn(task_.redundancy)) return true;
  const double middle = 0.5 * (task_.redundancy->from + task_.redundancy->to);
  const double angle = std::remainder(frames_.redundancy[point] + turn - middle, kTwoPi);
  return std::abs(angle) <= 0.5 * (task_.redundancy->to - task_.redundancy->from) + kIntervalRounding;
}

Ladder PathModel::whole_ladder(double step) const {
  Ladder ladder;
  ladder.closed = full_turn(task_.redundancy);
  const double from = ladder.closed ? -kPi : task_.redundancy->from;
  const double length = ladder.closed ? kTwoPi : task_.redundancy->to - from;
  const int steps = static_cast<int>(std::ceil(length / step - kIntervalRounding));
  ladder.step = steps > 0 ? length / steps : step;
  ladder.rungs = ladder.closed ? steps : steps + 1;
  for (const double at_zero : frames_.redundancy) {
    ladder.base.push_back(ladder.closed ? from - frames_.redundancy.front() : from - at_zero);
  }
  return ladder;
}

std::vector<StepLimit> PathModel::step_limits() const {
  std::vector<StepLimit> limits;
  for (std::size_t i = 0; i < size(); ++i) {
    StepLimit limit{JointAngles::Constant(kLargestJointStep), kLargestJointStep};
    if (frames_.time[i] > 0) {
      limit.joint = limit.joint.cwiseMin(task_.max_speed * frames_.time[i]);
      limit.turn = std::min(limit.turn, task_.most_turn_per_metre * frames_.distance[i]);
    } else if (std::isfinite(task_.most_turn_per_metre)) {
      limit.turn = 0;
    }
    limit.joint.array() -= kLimitRounding;
    limits.push_back(limit);
  }
  return limits;
}

ArmTarget PathModel::target(std::size_t point, double turn, Eigen::Matrix3d& axes) const {
  const Eigen::Isometry3d tool = tool_frame(task_.path, frames_, point, turn);
  axes = inverse_.home_from_base().linear() * tool.linear();
  return inverse_.target_of(tool);
}

void PathModel::costs(const ArmLanes& lanes, std::size_t point, const Eigen::Matrix3d& axes,
                      double cost[kArms]) const {
  double compliance[6][kArms];
  arm_compliances(lanes, home_point_[point].data(), springs_.joint, compliance);
  if (springs_.beyond_joints) add_spring_compliances(lanes, springs_, home_point_[point].data(), compliance);
  const StiffnessIndex& index = *task_.stiffness.index;
  const bool turns = task_.stiffness.force_in_tool && !task_.force_in_feed;
  ForceLoad load = load_[point];
  if (turns) load.force_n = axes * load.force_n;
  index.arm_scores(compliance, axes, load, cost);
  for (int arm = 0; arm < kArms; ++arm) cost[arm] = path_cost(index, cost[arm]);
}

void PathModel::store_lowest(const ArmLanes& lanes, int branch, double angles[kJoints]) const {
  for (int j = 0; j < kJoints; ++j) {
    angles[j] = lanes.angle[j][branch];
    if (copies_.count[j] > 1) angles[j] -= kTwoPi * std::floor((angles[j] - copies_.least_rad[j]) / kTwoPi);
  }
}

JointAngles PathModel::copy_of(const double angles[kJoints], int copy) const {
  JointAngles moved;
  for (int j = 0; j < kJoints; ++j) moved[j] = angles[j] + kTwoPi * copies_.turns[copy][j];
  return moved;
}

std::uint32_t PathModel::allowed_copies(const double angles[kJoints]) const {
  std::uint32_t allowed = ~std::uint32_t{0};
  for (int j = 0; j < kJoints; ++j) {
    const double room = robot_.joints[j].max_rad - task_.limit_margin_rad - angles[j];
    const double held = std::clamp(1 + std::floor(room / kTwoPi), 0.0, double{AngleCopies::kMostEach});
    allowed &= copies_.within[j][static_cast<int>(held)];
  }
  if (!coupled_copies_) return allowed;  // the coupled range is that of the most central copy, which is kept
  for (int c = 0; c < copies_.combinations; ++c) {
    if (limit_margin_rad(robot_, copy_of(angles, c)) < task_.limit_margin_rad)
      allowed &= ~(std::uint32_t{1} << c);
  }
  return allowed;
}

void PathModel::take_branch(const ArmLanes& lanes, int branch, int rung, double cost,
                            BranchRungs& rungs) const {
  double angles[kJoints];
  store_lowest(lanes, branch, angles);
  const std::uint32_t copies = allowed_copies(angles);
  if (copies == 0 || !std::isfinite(cost)) return;
  if (robot_.keeps_out()) {
    const RobotPose pose = robot_pose(robot_, Eigen::Map<const JointAngles>(angles));
    if (keep_out_margin_m(robot_, pose) < 0) return;
  }
  for (int j = 0; j < kJoints; ++j) rungs.angle[j][rung] = angles[j];
  rungs.cost[rung] = cost;
  rungs.copies[rung] = copies;
  rungs.any = true;
}

void PathModel::fill(const Ladder& ladder, std::size_t point, unsigned branches, PointRungs& rungs,
                     RungCosts* known, double most_cost) const {
  const auto n = static_cast<std::size_t>(ladder.rungs);
  for (int b = 0; b < kBranches; ++b) {
    if (!(branches >> b & 1)) continue;
    for (auto& angle : rungs[b].angle) angle.resize(n);
    rungs[b].cost.assign(n, kInfinity);
    rungs[b].copies.assign(n, 0);
    rungs[b].any = false;
  }
  ArmLanes lanes;
  double cost[kArms];
  bool away[kArms] = {true, true, true, true};
  Eigen::Matrix3d axes;
  const bool store = known && branches == kAllBranches;
  for (int k = 0; k < ladder.rungs; ++k) {
    const double turn = ladder.turn(point, k);
    if (known && known->costs_more(point, k, most_cost)) continue;
    if (store) known->store(point, k, kInfinity);
    if (!in_interval(point, turn)) continue;
    solve_arms(inverse_.constants(), target(point, turn, axes), lanes);
    unsigned inside = 0;
    for (int b = 0; b < kBranches; ++b) {
      if (lanes.limit_margin[b] >= task_.limit_margin_rad) inside |= 1U << b;
    }
    inside &= branches;
    if (inside == 0) continue;
    costs(lanes, point, axes, cost);
    if (task_.singularity_margin > 0) {
      arms_away_from_singularities(lanes, home_point_[point].data(), task_.singularity_margin, away);
    }
    double least = kInfinity;
    for (int b = 0; b < kBranches; ++b) {
      if (!(inside >> b & 1) || !away[b % kArms]) continue;
      take_branch(lanes, b, k, cost[b % kArms], rungs[b]);
      least = std::min(least, rungs[b].cost[k]);
    }
    if (store) known->store(point, k, least);
  }
}

JointAngles PathModel::angles(std::size_t point, double turn, int branch, int copy) const {
  ArmLanes lanes;
  Eigen::Matrix3d axes;
  solve_arms(inverse_.constants(), target(point, turn, axes), lanes);
  double angles[kJoints];
  store_lowest(lanes, branch, angles);
  return copy_of(angles, copy);
}

std::optional<PathModel::Pose> PathModel::pose(std::size_t point, double turn, int branch) const {
  ArmLanes lanes;
  Eigen::Matrix3d axes;
  solve_arms(inverse_.constants(), target(point, turn, axes), lanes);
  if (!std::isfinite(lanes.limit_margin[branch])) return std::nullopt;
  Pose pose;
  store_lowest(lanes, branch, pose.angles.data());
  double cost[kArms];
  costs(lanes, point, axes, cost);
  pose.cost = cost[branch % kArms];
  return pose;
}

PoseFault PathModel::fault(std::size_t point, double turn, int branch) const {
  const auto found = pose(point, turn, branch);
  if (!found) return {PoseFault::Kind::kReach};
  return fault_of(point, turn, most_central_copies(robot_, found->angles));
}

PoseFault PathModel::fault_of(std::size_t point, double turn, const JointAngles& angles) const {
  if (!in_interval(point, turn)) return {PoseFault::Kind::kRedundancy};
  PoseFault worst;
  for (int j = 0; j < kJoints; ++j) {
    const double missing = task_.limit_margin_rad - robot_.range(j, angles).margin_rad(angles[j]);
    if (missing > worst.missing) worst = {PoseFault::Kind::kLimit, j, missing};
  }
  if (worst.kind != PoseFault::Kind::kNone) return worst;
  const RobotPose at = robot_pose(robot_, angles);
  if (!is_away_from_singularities(at, task_.singularity_margin))
    return {PoseFault::Kind::kSingularity, 0, task_.singularity_margin - robot::singularity_margin(at)};
  if (const double margin = keep_out_margin_m(robot_, at); margin < 0)
    return {PoseFault::Kind::kKeepOut, 0, -margin};
  return worst;
}

}  // namespace stablecut::robot
