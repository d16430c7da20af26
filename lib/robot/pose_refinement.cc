#include "robot/pose_refinement.h"

#include <cmath>
#include <vector>

#include "base/units.h"
#include "numerics/constrained_maximum.h"

namespace stablecut::robot {
namespace {

constexpr int kMostRestarts = 10;

// Refinement over those of x, y and redundancy that are free and matter.
class Refinement {
 public:
  explicit Refinement(const PoseScanner& scanner) : scanner_(scanner), task_(scanner.task()) {}

  // The weakest principal stiffness has a ridge where two are equal, on which a smooth model fails. There a
  // power mean of the compliances stands for the largest of them, sharper and sharper, each from the best
  // point so far.
  std::optional<FoundPose> from(const PlanePoint& start, double radius) const {
    auto best = from(start, radius, 0);
    // On a narrow curved ridge a search may stop early; another from where it stopped goes on.
    for (int i = 0; best && i < kMostRestarts; ++i) {
      const auto again = from(best->at, radius, 0);
      if (!again || equal_scores(again->score, best->score)) break;
      best = again;
    }
    if (!best || !task_.stiffness.index->has_ridge) return best;
    for (const double power : {30.0, 300.0, 3000.0}) {
      const auto smoothed = from(best->at, radius, power);
      if (smoothed && smoothed->score > best->score) best = smoothed;
      radius *= 0.3;
    }
    return best;
  }

 private:
  static constexpr double kDifference = 1e-4;  // m and rad

  struct Freedom {
    double PlanePoint::*coordinate;
    double lower, upper;
  };

  std::optional<FoundPose> from(const PlanePoint& start, double radius, double power) const {
    std::vector<Freedom> free;
    if (!task_.x.is_point()) free.push_back({&PlanePoint::x, task_.x.from, task_.x.to});
    if (!task_.y.is_point()) free.push_back({&PlanePoint::y, task_.y.from, task_.y.to});
    if (!task_.redundancy.is_point() && scanner_.redundancy_matters()) {
      const bool open = task_.full_turn();
      free.push_back(
          {&PlanePoint::redundancy, open ? -100 : task_.redundancy.from, open ? 100 : task_.redundancy.to});
    }
    const Eigen::Index n = free.size();
    numerics::Variables first(n), lower(n), upper(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      first[i] = start.*free[i].coordinate;
      lower[i] = free[i].lower;
      upper[i] = free[i].upper;
    }
    const auto point = [&](const numerics::Variables& x) {
      PlanePoint at = start;
      for (Eigen::Index i = 0; i < n; ++i) at.*free[i].coordinate = x[i];
      return at;
    };
    const auto found =
        numerics::constrained_maximum([&](const numerics::Variables& x) { return value(point(x), power); },
                                      first, lower, upper, radius, kDifference);
    if (!found) return std::nullopt;
    PlanePoint at = point(found->point);
    if (task_.full_turn()) at.redundancy = std::remainder(at.redundancy, kTwoPi);
    const auto evaluation = scanner_.evaluate(at);
    if (!evaluation) return std::nullopt;
    return FoundPose{at, evaluation->angles, evaluation->score};
  }

  std::optional<numerics::ConstrainedValue> value(const PlanePoint& at, double power) const {
    const auto evaluation = scanner_.evaluate(at);
    if (!evaluation || !(evaluation->score > 0)) return std::nullopt;
    numerics::ConstrainedValue result;
    double logarithm = std::log(evaluation->score);
    if (power > 0) {
      const Eigen::Vector3d compliances = principal_compliances(evaluation->compliance);
      logarithm -= std::log((compliances / compliances[0]).cwiseMax(0.0).array().pow(power).sum()) / power;
    }
    result.value = task_.stiffness.index->larger_is_better ? logarithm : -logarithm;
    const bool away = task_.singularity_margin > 0;
    result.constraints.resize(kJoints + (away ? 1 : 0));
    for (int j = 0; j < kJoints; ++j) {
      const Joint& joint = scanner_.robot().joints[j];
      result.constraints[j] = joint.margin_rad(evaluation->angles[j]) - task_.limit_margin_rad;
    }
    if (away) {
      result.constraints[kJoints] =
          singularity_margin(robot_pose(scanner_.robot(), evaluation->angles)) - task_.singularity_margin;
    }
    return result;
  }

  const PoseScanner& scanner_;
  const PoseTask& task_;
};

}  // namespace

bool equal_scores(double a, double b) { return std::abs(a - b) <= 1e-7 * std::abs(b); }

std::optional<FoundPose> refined_pose(const PoseScanner& scanner, const PlanePoint& start, double radius) {
  return Refinement(scanner).from(start, radius);
}

}  // namespace stablecut::robot
