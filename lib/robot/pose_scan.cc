#include "robot/pose_scan.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/units.h"

namespace stablecut {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Scores by the lanes' compliances, without leaving the home frame.
class ArmScores {
 public:
  ArmScores(const StiffnessTask& task, const double compliance[6][kArms]) : task_(task), c_(compliance) {}

  // `axes`: the tool's x, y, z; `force`: what acts, for kDeflection; both in the home frame.
  void merits(const Eigen::Matrix3d& axes, const Eigen::Vector3d& force, double merit[kArms]) const {
    switch (task_.index) {
      case StiffnessIndex::kCombined:
        for (int i = 0; i < kArms; ++i) {
          merit[i] =
              std::sqrt(1 / squared_displacement(axes.col(0), i) + 1 / squared_displacement(axes.col(1), i) +
                        1 / squared_displacement(axes.col(2), i));
        }
        return;
      case StiffnessIndex::kWeakest: {
        largest_arm_compliances(c_, merit);
        for (int i = 0; i < kArms; ++i) merit[i] = 1 / merit[i];
        return;
      }
      case StiffnessIndex::kAxial:
        for (int i = 0; i < kArms; ++i) merit[i] = 1 / std::sqrt(squared_displacement(axes.col(2), i));
        return;
      case StiffnessIndex::kDeflection:
        for (int i = 0; i < kArms; ++i) merit[i] = -std::sqrt(squared_displacement(force, i));
        return;
    }
  }

 private:
  double squared_displacement(const Eigen::Ref<const Eigen::Vector3d>& f, int i) const {
    const double x = c_[0][i] * f[0] + c_[1][i] * f[1] + c_[2][i] * f[2];
    const double y = c_[1][i] * f[0] + c_[3][i] * f[1] + c_[4][i] * f[2];
    const double z = c_[2][i] * f[0] + c_[4][i] * f[1] + c_[5][i] * f[2];
    return x * x + y * y + z * z;
  }

  const StiffnessTask& task_;
  const double (*c_)[kArms];
};

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
  if (task.stiffness.index == StiffnessIndex::kDeflection && !task.stiffness.force_n) {
    throw InvalidArgument("force: missing: expected a force for the index deflection");
  }
  const double along = robot.tool_in_frame6().linear()(2, 2) > 0 ? 1 : -1;
  turn_sense_ = along * robot.joints[5].theta_sign;
  for (int i = 0; i < task.redundancy.count; ++i) redundancy_.push_back(task.redundancy.at(i));
}

void PoseScanner::collect(double x, double y, std::vector<Candidate>& candidates, PointScan& result) const {
  const Eigen::Matrix3d to_home = inverse_.home_from_base().linear();
  const Eigen::Vector3d point = task_.plane.at(x, y);
  const Eigen::Vector3d home_point = inverse_.home_from_base() * point;
  const Eigen::Isometry3d first = tool_frame(point, task_.tool_axis, 0);
  const Eigen::Vector3d x0 = to_home * first.linear().col(0), y0 = to_home * first.linear().col(1);
  Eigen::Matrix3d axes;
  axes.col(2) = to_home * first.linear().col(2);
  const StiffnessTask& stiffness = task_.stiffness;
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  if (stiffness.force_n && !stiffness.force_in_tool) force = to_home * *stiffness.force_n;

  candidates.clear();
  result.best_limit_margin_rad = -kInfinity;
  ArmLanes lanes;
  double compliance[6][kArms], merit[kArms];
  double margin_of_five[kBranches], angle6[kBranches];
  const auto use = [&](double margin, int sample, int branch) {
    if (margin > result.best_limit_margin_rad) {
      result.best_limit_margin_rad = margin;
      result.least_outside = {0, {x, y, redundancy_[static_cast<std::size_t>(sample)], branch}};
    }
    return margin >= task_.limit_margin_rad;
  };
  if (coaxial_) {
    // Joint 6 alone turns the tool: one arm solution and one compliance for all redundancy angles.
    solve_arms(inverse_.constants(), inverse_.target_of(first), lanes);
    const ArmConstants& k = inverse_.constants();
    bool any = false;
    for (int b = 0; b < kBranches; ++b) {
      margin_of_five[b] = std::isfinite(lanes.limit_margin[b]) ? kInfinity : -kInfinity;
      for (int j = 0; j < 5; ++j) {
        margin_of_five[b] =
            std::min(margin_of_five[b], k.half_range[j] - std::abs(lanes.angle[j][b] - k.middle[j]));
      }
      angle6[b] = lanes.angle[5][b];
      any = any || margin_of_five[b] >= task_.limit_margin_rad;
      if (margin_of_five[b] > result.best_limit_margin_rad) {
        result.best_limit_margin_rad = margin_of_five[b];
        result.least_outside = {0, {x, y, redundancy_.front(), b}};
      }
    }
    if (!any) return;
    result.best_limit_margin_rad = -kInfinity;
    arm_compliances(lanes, home_point.data(), task_.joint_compliance.data(), compliance);
    const ArmScores scores(stiffness, compliance);
    const bool blind = stiffness.blind_to_tool_turn();
    if (blind) scores.merits(axes, force, merit);
    for (int sample = 0; sample < static_cast<int>(redundancy_.size()); ++sample) {
      const double turn = redundancy_[static_cast<std::size_t>(sample)];
      if (!blind) {
        const double c = std::cos(turn), s = std::sin(turn);
        axes.col(0) = c * x0 + s * y0;
        axes.col(1) = c * y0 - s * x0;
        if (stiffness.force_n && stiffness.force_in_tool) force = axes * *stiffness.force_n;
        scores.merits(axes, force, merit);
      }
      for (int b = 0; b < kBranches; ++b) {
        if (margin_of_five[b] < task_.limit_margin_rad) continue;
        double q6 = angle6[b] + turn_sense_ * turn;
        q6 += kTwoPi * std::nearbyint((k.middle[5] - q6) / kTwoPi);
        const double margin = std::min(margin_of_five[b], k.half_range[5] - std::abs(q6 - k.middle[5]));
        if (use(margin, sample, b)) candidates.push_back({merit[b % kArms], margin, sample, b});
      }
    }
    return;
  }
  for (int sample = 0; sample < static_cast<int>(redundancy_.size()); ++sample) {
    const double turn = redundancy_[static_cast<std::size_t>(sample)];
    solve_arms(inverse_.constants(), inverse_.target_of(tool_frame(point, task_.tool_axis, turn)), lanes);
    bool any = false;
    for (int b = 0; b < kBranches; ++b) any = use(lanes.limit_margin[b], sample, b) || any;
    if (!any) continue;
    const double c = std::cos(turn), s = std::sin(turn);
    axes.col(0) = c * x0 + s * y0;
    axes.col(1) = c * y0 - s * x0;
    if (stiffness.force_n && stiffness.force_in_tool) force = axes * *stiffness.force_n;
    arm_compliances(lanes, home_point.data(), task_.joint_compliance.data(), compliance);
    ArmScores(stiffness, compliance).merits(axes, force, merit);
    for (int b = 0; b < kBranches; ++b) {
      if (lanes.limit_margin[b] >= task_.limit_margin_rad) {
        candidates.push_back({merit[b % kArms], lanes.limit_margin[b], sample, b});
      }
    }
  }
}

PointScan PoseScanner::scan(double x, double y) const {
  thread_local std::vector<Candidate> candidates;
  PointScan result;
  collect(x, y, candidates, result);
  const auto size_of_turn = [&](const Candidate& c) {
    return std::abs(redundancy_[static_cast<std::size_t>(c.sample)]);
  };
  const auto better = [&](const Candidate& a, const Candidate& b) {
    if (a.merit != b.merit) return a.merit > b.merit;
    if (a.limit_margin != b.limit_margin) return a.limit_margin > b.limit_margin;
    return size_of_turn(a) < size_of_turn(b);
  };
  for (int arm = 0; arm < kArms; ++arm) {
    // The best one that is away from singularities; mostly the first that is looked at.
    for (;;) {
      Candidate* best = nullptr;
      for (Candidate& candidate : candidates) {
        if (candidate.branch % kArms == arm && candidate.merit > -kInfinity &&
            (!best || better(candidate, *best))) {
          best = &candidate;
        }
      }
      if (!best) break;
      const PlanePoint at{x, y, redundancy_[static_cast<std::size_t>(best->sample)], best->branch};
      if (task_.singularity_margin > 0) {
        const auto evaluation = evaluate(at);
        if (!evaluation ||
            singularity_margin(robot_pose(robot_, evaluation->angles)) < task_.singularity_margin) {
          if (coaxial_) break;  // joint 6 does not change the singular values either
          best->merit = -kInfinity;
          continue;
        }
      }
      result.arms[static_cast<std::size_t>(arm)] = ScanBest{best->merit, at};
      break;
    }
  }
  return result;
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

}  // namespace stablecut
