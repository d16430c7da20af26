#include "robot/pose_scan.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "base/error.h"
#include "base/units.h"

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
    : robot_(robot), task_(task), inverse_(robot), coaxial_(tool_alignment(robot).coaxial()) {
  if (task.stiffness.index->needs_force && !task.stiffness.force_n) {
    throw InvalidArgument(std::string("force: missing: expected a force for the index ") +
                          task.stiffness.index->name);
  }
  const double along = robot.tool_in_frame6().linear()(2, 2) > 0 ? 1 : -1;
  turn_sense_ = along * robot.joints[5].theta_sign;
  for (int i = 0; i < task.redundancy.count; ++i) {
    const double turn = task.redundancy.at(i);
    const Eigen::Isometry3d tool = tool_frame(Eigen::Vector3d::Zero(), task.tool_axis, turn);
    samples_.push_back({turn, inverse_.target_of(tool), inverse_.home_from_base().linear() * tool.linear()});
  }
}

// Calls use(candidate) for every sample and branch within reach that keeps the limit margin; the order is
// that of the samples. Also finds what is nearest to the limits.
template <typename Use>
void PoseScanner::visit(double x, double y, PointScan& result, const Use& use) const {
  const Eigen::Vector3d point = task_.plane.at(x, y);
  const Eigen::Vector3d home_point = inverse_.home_from_base() * point;
  const StiffnessTask& stiffness = task_.stiffness;
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  if (stiffness.force_n && !stiffness.force_in_tool) {
    force = inverse_.home_from_base().linear() * *stiffness.force_n;
  }
  const auto solve = [&](const Sample& sample, ArmLanes& lanes) {
    ArmTarget target = sample.target;
    for (int d = 0; d < 3; ++d) target.origin[d] += point[d];
    solve_arms(inverse_.constants(), target, lanes);
  };
  ArmLanes lanes;
  double compliance[6][kArms], merit[kArms] = {};
  const auto score = [&](const Sample& sample) {
    if (stiffness.force_n && stiffness.force_in_tool) force = sample.axes * *stiffness.force_n;
    stiffness.index->arm_scores(compliance, sample.axes, force, merit);
    if (!stiffness.index->larger_is_better) {
      for (double& m : merit) m = -m;
    }
  };
  const auto offer = [&](double margin, int sample, int branch) {
    if (margin > result.best_limit_margin_rad) {
      result.best_limit_margin_rad = margin;
      result.least_outside = {0, {x, y, samples_[sample].turn, branch}};
    }
    if (margin >= task_.limit_margin_rad) use(Candidate{merit[branch % kArms], margin, sample, branch});
  };
  const auto within = [&](const double margin[kBranches]) {
    return std::any_of(margin, margin + kBranches, [&](double m) { return m >= task_.limit_margin_rad; });
  };
  const int count = static_cast<int>(samples_.size());
  if (!coaxial_) {
    for (int i = 0; i < count; ++i) {
      const Sample& sample = samples_[i];
      solve(sample, lanes);
      if (within(lanes.limit_margin)) {
        arm_compliances(lanes, home_point.data(), task_.joint_compliance.data(), compliance);
        score(sample);
      }
      for (int b = 0; b < kBranches; ++b) offer(lanes.limit_margin[b], i, b);
    }
    return;
  }
  // Joint 6 alone turns the tool: one arm solution and one compliance for all redundancy angles.
  const ArmConstants& k = inverse_.constants();
  solve(samples_.front(), lanes);
  double margin_of_five[kBranches];
  for (int b = 0; b < kBranches; ++b) {
    margin_of_five[b] = std::isfinite(lanes.limit_margin[b]) ? kInfinity : -kInfinity;
    for (int j = 0; j < 5; ++j) {
      margin_of_five[b] = std::min(margin_of_five[b], robot_.joints[j].margin_rad(lanes.angle[j][b]));
    }
  }
  if (!within(margin_of_five)) {
    for (int b = 0; b < kBranches; ++b) offer(lanes.limit_margin[b], 0, b);
    return;
  }
  arm_compliances(lanes, home_point.data(), task_.joint_compliance.data(), compliance);
  score(samples_.front());
  for (int i = 0; i < count; ++i) {
    const Sample& sample = samples_[i];
    if (i > 0 && stiffness.feels_tool_turn()) score(sample);
    for (int b = 0; b < kBranches; ++b) {
      double q6 = lanes.angle[5][b] + turn_sense_ * (sample.turn - samples_.front().turn);
      q6 += kTwoPi * std::nearbyint((k.middle[5] - q6) / kTwoPi);
      offer(std::min(margin_of_five[b], robot_.joints[5].margin_rad(q6)), i, b);
    }
  }
}

bool PoseScanner::better(const Candidate& a, const Candidate& b) const {
  if (a.merit != b.merit) return a.merit > b.merit;
  if (a.limit_margin != b.limit_margin) return a.limit_margin > b.limit_margin;
  return std::abs(samples_[a.sample].turn) < std::abs(samples_[b.sample].turn);
}

ScanBest PoseScanner::place_of(const Candidate& candidate, double x, double y) const {
  return {candidate.merit, {x, y, samples_[candidate.sample].turn, candidate.branch}};
}

bool PoseScanner::away_from_singularities(const PlanePoint& at) const {
  if (!(task_.singularity_margin > 0)) return true;
  const auto evaluation = evaluate(at);
  return evaluation &&
         is_away_from_singularities(robot_pose(robot_, evaluation->angles), task_.singularity_margin);
}

PointScan PoseScanner::scan(double x, double y) const {
  PointScan result;
  result.best_limit_margin_rad = -kInfinity;
  std::array<std::optional<Candidate>, kArms> best;
  visit(x, y, result, [&](const Candidate& candidate) {
    auto& arm = best[candidate.branch % kArms];
    if (!arm || better(candidate, *arm)) arm = candidate;
  });
  for (std::size_t arm = 0; arm < kArms; ++arm) {
    if (!best[arm]) continue;
    const ScanBest place = place_of(*best[arm], x, y);
    if (away_from_singularities(place.at)) {
      result.arms[arm] = place;
    } else if (!coaxial_) {  // else joint 6 does not change the singular values either
      result.arms[arm] = next_best(x, y, static_cast<int>(arm));
    }
  }
  return result;
}

std::optional<ScanBest> PoseScanner::next_best(double x, double y, int arm) const {
  std::vector<Candidate> candidates;
  PointScan ignored;
  visit(x, y, ignored, [&](const Candidate& candidate) {
    if (candidate.branch % kArms == arm) candidates.push_back(candidate);
  });
  std::stable_sort(candidates.begin(), candidates.end(),
                   [&](const Candidate& a, const Candidate& b) { return better(a, b); });
  for (const Candidate& candidate : candidates) {
    const ScanBest place = place_of(candidate, x, y);
    if (away_from_singularities(place.at)) return place;
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
  arm_compliances(lanes, point.data(), task_.joint_compliance.data(), c);
  const int i = at.branch % kArms;
  Eigen::Matrix3d home;
  home << c[0][i], c[1][i], c[2][i], c[1][i], c[3][i], c[4][i], c[2][i], c[4][i], c[5][i];
  const Eigen::Matrix3d to_home = inverse_.home_from_base().linear();
  evaluation.compliance = to_home.transpose() * home * to_home;
  evaluation.score = stiffness_score(evaluation.compliance, evaluation.tool.linear(), task_.stiffness);
  return evaluation;
}

}  // namespace stablecut::robot
