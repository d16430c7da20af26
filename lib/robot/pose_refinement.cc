#include "robot/pose_refinement.h"

#include <cmath>
#include <vector>

#include "base/units.h"
#include "numerics/constrained_maximum.h"
#include "robot/keep_out.h"

namespace stablecut::robot {
namespace {

constexpr double kEqualScores = 1e-7;  // relative
constexpr int kMostRestarts = 10;
constexpr double kRidgePowers[] = {30, 300, 3000, 30000};  // of the power means that stand for a ridge
constexpr double kRidgeRadius = 0.3;                       // of the radius of the power before
constexpr double kDifference = 1e-4;                       // m and rad, of the derivatives
constexpr double kUnboundedTurn = 100;                     // rad: bound of a redundancy that is the full turn

// Refinement over those of x, y and redundancy that are free and matter.
class Refinement {
 public:
  explicit Refinement(const PoseScanner& scanner) : scanner_(scanner), task_(scanner.task()) {
    const PoseTask& task = task_;
    if (!task.x.is_point()) free_.push_back({&PlanePoint::x, task.x.from, task.x.to});
    if (!task.y.is_point()) free_.push_back({&PlanePoint::y, task.y.from, task.y.to});
    if (!task.redundancy.is_point() && scanner.redundancy_matters()) {
      const bool full = task.full_turn();
      free_.push_back({&PlanePoint::redundancy, full ? -kUnboundedTurn : task.redundancy.from,
                       full ? kUnboundedTurn : task.redundancy.to});
    }
  }

  std::optional<FoundPose> from(const PlanePoint& start, double radius) const {
    if (task_.stiffness.has_kink()) return along_ridge(start, radius);
    auto best = optimum(start, radius, 0);
    // On a narrow curved ridge a search may stop early: one more from where it stopped goes on.
    for (int i = 0; best && i < kMostRestarts; ++i) {
      const auto again = optimum(best->at, radius, 0);
      if (!again || equal_scores(again->score, best->score)) break;
      best = again;
    }
    return best;
  }

 private:
  struct Freedom {
    double PlanePoint::*coordinate;
    double lower, upper;
  };

  // First of what is smooth, from the mildest smoothing to the sharpest: the score itself has a kink on the
  // ridge, and a search that meets it creeps.
  std::optional<FoundPose> along_ridge(PlanePoint at, double radius) const {
    std::optional<FoundPose> best;
    for (const double power : kRidgePowers) {
      const auto smoothed = optimum(at, radius, power);
      if (!smoothed) continue;
      at = smoothed->at;
      if (!best || !worse(smoothed->score, best->score)) best = smoothed;
      radius *= kRidgeRadius;
    }
    return best;
  }

  bool worse(double a, double b) const { return task_.stiffness.index->larger_is_better ? a < b : a > b; }

  // The constrained maximum of the score from `start`; with a power, of the score that smooths the ridge.
  std::optional<FoundPose> optimum(const PlanePoint& start, double radius, double power) const {
    const auto first_pose = scanner_.evaluate(start);
    if (!first_pose) return std::nullopt;
    const Eigen::Index n = free_.size();
    numerics::Variables first(n), lower(n), upper(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      first[i] = start.*free_[i].coordinate;
      lower[i] = free_[i].lower;
      upper[i] = free_[i].upper;
    }
    const auto point = [&](const numerics::Variables& x) {
      PlanePoint at = start;
      for (Eigen::Index i = 0; i < n; ++i) at.*free_[i].coordinate = x[i];
      return at;
    };
    const auto found = numerics::constrained_maximum(
        [&](const numerics::Variables& x) { return value(point(x), power, first_pose->score); }, first, lower,
        upper, radius, kDifference);
    if (!found) return std::nullopt;
    PlanePoint at = point(found->point);
    if (task_.full_turn()) at.redundancy = std::remainder(at.redundancy, kTwoPi);
    const auto evaluation = scanner_.evaluate(at);
    if (!evaluation) return std::nullopt;
    return FoundPose{at, evaluation->angles, evaluation->score};
  }

  // The score, or with a power its smooth stand-in, as the negative of a squared compliance (a deflection, or
  // the inverse of a stiffness) in units of that of the score `unit`; and the distances from what limits the
  // pose. The square of a deflection is smooth also where the deflection is 0; its logarithm has a pole
  // there, beside which a search walks in small steps.
  std::optional<numerics::ConstrainedValue> value(const PlanePoint& at, double power, double unit) const {
    const auto evaluation = scanner_.evaluate(at);
    if (!evaluation || !(evaluation->score > 0)) return std::nullopt;
    numerics::ConstrainedValue result;
    const Eigen::Matrix3d axes = evaluation->tool.linear();
    const double score =
        power > 0 ? smooth_score(evaluation->compliance, axes, task_.stiffness, power) : evaluation->score;
    const double compliance = task_.stiffness.index->larger_is_better ? unit / score : score / unit;
    result.value = -compliance * compliance;
    const Robot& robot = scanner_.robot();
    const RobotPose pose = robot_pose(robot, evaluation->angles);
    const double least = task_.singularity_margin, keep_out = keep_out_margin_m(robot, pose);
    const bool away = least > 0, out = std::isfinite(keep_out);
    result.constraints.resize(kJoints + away + out);
    for (int j = 0; j < kJoints; ++j) {
      const AngleRange range = robot.range(j, evaluation->angles);
      result.constraints[j] = range.margin_rad(evaluation->angles[j]) - task_.limit_margin_rad;
    }
    // The squares, as the margin itself falls like a root towards the stretched arm.
    if (away) result.constraints[kJoints] = (squared_singularity_margin(pose) - least * least) / (2 * least);
    if (out) result.constraints[kJoints + away] = keep_out;
    return result;
  }

  const PoseScanner& scanner_;
  const PoseTask& task_;
  std::vector<Freedom> free_;
};

}  // namespace

bool equal_scores(double a, double b) { return std::abs(a - b) <= kEqualScores * std::abs(b); }

std::optional<FoundPose> refined_pose(const PoseScanner& scanner, const PlanePoint& start, double radius) {
  return Refinement(scanner).from(start, radius);
}

}  // namespace stablecut::robot
