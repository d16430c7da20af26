#include "robot/pose_scan.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "base/error.h"
#include "base/units.h"
#include "robot/keep_out.h"

namespace stablecut::robot {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

std::optional<ScanBest> PointScan::best() const {
  std::optional<ScanBest> found;
  for (const auto& arm : arms) {
    if (arm && (!found || arm->merit > found->merit)) found = arm;
  }
  return found;
}

PoseScanner::PoseScanner(const Robot& robot, const PoseTask& task)
    : robot_(robot),
      task_(task),
      inverse_(robot),
      springs_(arm_springs(robot, task.elasticity, inverse_)),
      coaxial_(tool_alignment(robot).coaxial()) {
  check_force(task.stiffness);
  const double along = robot.tool_in_frame6().linear()(2, 2) > 0 ? 1 : -1;
  turn_sense_ = along * robot.joints[5].theta_sign;
  const auto to_home = inverse_.home_from_base().linear();
  for (int i = 0; i < task.redundancy.count; ++i) {
    const double turn = task.redundancy.at(i);
    const Eigen::Isometry3d tool = tool_frame(Eigen::Vector3d::Zero(), task.tool_axis, turn);
    const Eigen::Matrix3d axes = to_home * tool.linear();
    const ForceLoad load = task.stiffness.force_n && task.stiffness.force_in_tool
                               ? task.stiffness.load(axes * *task.stiffness.force_n)
                               : turned(load_in_base(task.stiffness, tool.linear()), to_home);
    samples_.push_back({turn, inverse_.target_of(tool), axes, load});
  }
}

void PoseScanner::solve(const Sample& sample, const Eigen::Vector3d& point, ArmLanes& lanes) const {
  ArmTarget target = sample.target;
  for (int d = 0; d < 3; ++d) target.origin[d] += point[d];
  solve_arms(inverse_.constants(), target, lanes);
}

void PoseScanner::compliances(const ArmLanes& lanes, const Eigen::Vector3d& home_point,
                              double compliance[6][kArms]) const {
  arm_compliances(lanes, home_point.data(), springs_.joint, compliance);
  if (springs_.beyond_joints) add_spring_compliances(lanes, springs_, home_point.data(), compliance);
}

bool PoseScanner::any_keeps_limits(const double margin[kBranches]) const {
  return std::any_of(margin, margin + kBranches, [&](double m) { return m >= task_.limit_margin_rad; });
}

void PoseScanner::arm_merits(const Sample& sample, const double compliance[6][kArms],
                             double merit[kArms]) const {
  const StiffnessIndex& index = *task_.stiffness.index;
  index.arm_scores(compliance, sample.axes, sample.load, merit);
  if (index.larger_is_better) return;
  for (int arm = 0; arm < kArms; ++arm) merit[arm] = -merit[arm];
}

template <typename Take>
void PoseScanner::scan_samples(const Eigen::Vector3d& point, const Take& take) const {
  const Eigen::Vector3d home_point = inverse_.home_from_base() * point;
  ArmLanes lanes;
  double compliance[6][kArms], merit[kArms] = {};
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    solve(samples_[i], point, lanes);
    if (any_keeps_limits(lanes.limit_margin)) {
      compliances(lanes, home_point, compliance);
      arm_merits(samples_[i], compliance, merit);
    }
    for (int b = 0; b < kBranches; ++b) {
      take(Candidate{merit[b % kArms], lanes.limit_margin[b], static_cast<int>(i), b});
    }
  }
}

// Joint 6 alone turns a coaxial tool, and its bearing yields alike in all directions: one arm solution and
// one compliance for all redundancy angles.
template <typename Take>
void PoseScanner::scan_coaxial_samples(const Eigen::Vector3d& point, const Take& take) const {
  const Eigen::Vector3d home_point = inverse_.home_from_base() * point;
  ArmLanes lanes;
  double compliance[6][kArms], merit[kArms] = {};
  solve(samples_.front(), point, lanes);
  double margin_of_five[kBranches];
  AngleRange range6[kBranches];
  for (int b = 0; b < kBranches; ++b) {
    JointAngles angles;
    for (int j = 0; j < kJoints; ++j) angles[j] = lanes.angle[j][b];
    margin_of_five[b] = std::isfinite(lanes.limit_margin[b]) ? kInfinity : -kInfinity;
    for (int j = 0; j < 5; ++j) {
      margin_of_five[b] = std::min(margin_of_five[b], robot_.range(j, angles).margin_rad(angles[j]));
    }
    range6[b] = robot_.range(5, angles);
  }
  if (!any_keeps_limits(margin_of_five)) {
    for (int b = 0; b < kBranches; ++b) take(Candidate{0, lanes.limit_margin[b], 0, b});
    return;
  }
  compliances(lanes, home_point, compliance);
  arm_merits(samples_.front(), compliance, merit);
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    const Sample& sample = samples_[i];
    if (i > 0 && task_.stiffness.feels_tool_turn()) arm_merits(sample, compliance, merit);
    for (int b = 0; b < kBranches; ++b) {
      double q6 = lanes.angle[5][b] + turn_sense_ * (sample.turn - samples_.front().turn);
      q6 += kTwoPi * std::nearbyint((range6[b].middle_rad() - q6) / kTwoPi);
      take(Candidate{merit[b % kArms], std::min(margin_of_five[b], range6[b].margin_rad(q6)),
                     static_cast<int>(i), b});
    }
  }
}

// Calls take_allowed(candidate) for every sample and branch within reach that keeps the limit margin, in the
// order of the samples, and finds the most central pose of all.
template <typename TakeAllowed>
void PoseScanner::for_each_allowed(double x, double y, PointScan& result,
                                   const TakeAllowed& take_allowed) const {
  const Eigen::Vector3d point = task_.plane.at(x, y);
  const auto take = [&](const Candidate& candidate) {
    if (candidate.limit_margin > result.best_limit_margin_rad) {
      result.best_limit_margin_rad = candidate.limit_margin;
      result.most_central = place_of(candidate, x, y).at;
    }
    if (candidate.limit_margin >= task_.limit_margin_rad) take_allowed(candidate);
  };
  if (one_compliance())
    scan_coaxial_samples(point, take);
  else
    scan_samples(point, take);
}

bool PoseScanner::better(const Candidate& a, const Candidate& b) const {
  if (a.merit != b.merit) return a.merit > b.merit;
  if (a.limit_margin != b.limit_margin) return a.limit_margin > b.limit_margin;
  return std::abs(samples_[a.sample].turn) < std::abs(samples_[b.sample].turn);
}

ScanBest PoseScanner::place_of(const Candidate& candidate, double x, double y) const {
  return {candidate.merit, {x, y, samples_[candidate.sample].turn, candidate.branch}};
}

// From singularities and from what is to be kept out of.
bool PoseScanner::keeps_distance(const PlanePoint& at) const {
  const auto evaluation = evaluate(at);
  if (!evaluation) return false;
  const RobotPose pose = robot_pose(robot_, evaluation->angles);
  return is_away_from_singularities(pose, task_.singularity_margin) && keep_out_margin_m(robot_, pose) >= 0;
}

PointScan PoseScanner::scan(double x, double y) const {
  PointScan result;
  result.best_limit_margin_rad = -kInfinity;
  std::array<std::optional<Candidate>, kArms> best;
  for_each_allowed(x, y, result, [&](const Candidate& candidate) {
    auto& arm = best[candidate.branch % kArms];
    if (!arm || better(candidate, *arm)) arm = candidate;
  });
  for (std::size_t arm = 0; arm < kArms; ++arm) {
    if (!best[arm]) continue;
    const ScanBest place = place_of(*best[arm], x, y);
    if (keeps_distance(place.at)) {
      result.arms[arm] = place;
    } else if (!coaxial_ || !robot_.joints[5].capsules.empty()) {
      // Of a coaxial tool joint 6 changes neither the singular values nor where the tool is.
      result.arms[arm] = next_best(x, y, static_cast<int>(arm));
    }
  }
  return result;
}

// The best of an arm that keeps its distance, where the best of all does not.
std::optional<ScanBest> PoseScanner::next_best(double x, double y, int arm) const {
  std::vector<Candidate> candidates;
  PointScan ignored;
  for_each_allowed(x, y, ignored, [&](const Candidate& candidate) {
    if (candidate.branch % kArms == arm) candidates.push_back(candidate);
  });
  std::stable_sort(candidates.begin(), candidates.end(),
                   [&](const Candidate& a, const Candidate& b) { return better(a, b); });
  for (const Candidate& candidate : candidates) {
    const ScanBest place = place_of(candidate, x, y);
    if (keeps_distance(place.at)) return place;
  }
  return std::nullopt;
}

std::optional<PoseScanner::Evaluation> PoseScanner::evaluate(const PlanePoint& at) const {
  ArmLanes lanes;
  Evaluation evaluation;
  evaluation.tool = tool_frame(task_.plane.at(at.x, at.y), task_.tool_axis, at.redundancy);
  solve_arms(inverse_.constants(), inverse_.target_of(evaluation.tool), lanes);
  if (!std::isfinite(lanes.limit_margin[at.branch])) return std::nullopt;
  for (int j = 0; j < kJoints; ++j) evaluation.angles[j] = lanes.angle[j][at.branch];
  double c[6][kArms];
  const Eigen::Vector3d point = inverse_.home_from_base() * evaluation.tool.translation();
  compliances(lanes, point, c);
  const int i = at.branch % kArms;
  Eigen::Matrix3d home;
  home << c[0][i], c[1][i], c[2][i], c[1][i], c[3][i], c[4][i], c[2][i], c[4][i], c[5][i];
  const Eigen::Matrix3d to_home = inverse_.home_from_base().linear();
  evaluation.compliance = to_home.transpose() * home * to_home;
  evaluation.score = stiffness_score(evaluation.compliance, evaluation.tool.linear(), task_.stiffness);
  return evaluation;
}

}  // namespace stablecut::robot
