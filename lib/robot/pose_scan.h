// The best pose at a point of the plane among sampled redundancy angles and all branches.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "robot/inverse.h"
#include "robot/pose_task.h"

namespace stablecut::robot {

/// The best pose of a point, or of a point and one arm.
struct ScanBest {
  double merit = 0;  ///< the score where larger is better, else its negative
  PlanePoint at;
};

/// What a point of the plane offers.
struct PointScan {
  std::array<std::optional<ScanBest>, kArms> arms;  ///< allowed poses
  double best_limit_margin_rad = 0;                 ///< over all that reaches; -infinity when nothing does
  ScanBest least_outside;                           ///< where that is; merit means nothing

  std::optional<ScanBest> best() const;
};

/// Scans a task's redundancy samples. Thread-safe.
class PoseScanner {
 public:
  /// Throws InvalidArgument for a robot without analytic inverse kinematics or a task without a needed force.
  PoseScanner(const Robot& robot, const PoseTask& task);

  /// Among equal scores the pose of the largest limit margin and then the smallest turn wins, so that a
  /// redundancy that cannot matter is left where it is most comfortable.
  PointScan scan(double x, double y) const;

  /// A branch at a point: its angles and what the search needs, or nothing out of reach.
  struct Evaluation {
    JointAngles angles;
    Eigen::Matrix3d compliance;  ///< m/N, base frame
    Eigen::Isometry3d tool;      ///< base frame, m
    double score = 0;
  };
  std::optional<Evaluation> evaluate(const PlanePoint& point) const;

  const Robot& robot() const { return robot_; }
  const PoseTask& task() const { return task_; }
  /// False when turning the tool about its axis cannot change the score: tool coaxial with joint 6, index
  /// blind to it.
  bool redundancy_matters() const { return !coaxial_ || task_.stiffness.feels_tool_turn(); }

  /// Sense of controller angle 6 against the redundancy angle, for a coaxial tool.
  double turn_sense() const { return turn_sense_; }

 private:
  struct Candidate {
    double merit, limit_margin;
    int sample, branch;
  };
  template <typename Use>
  void visit(double x, double y, PointScan& result, const Use& use) const;
  bool better(const Candidate& a, const Candidate& b) const;
  ScanBest place_of(const Candidate& candidate, double x, double y) const;
  bool away_from_singularities(const PlanePoint& at) const;
  /// The best of an arm that is away from singularities, where the best of all is not.
  std::optional<ScanBest> next_best(double x, double y, int arm) const;

  const Robot& robot_;
  const PoseTask& task_;
  InverseKinematics inverse_;
  bool coaxial_;
  double turn_sense_;
  struct Sample {
    double turn;           // redundancy angle, rad
    ArmTarget target;      // for a tool point at the base's origin
    Eigen::Matrix3d axes;  // of the tool, home frame
  };
  std::vector<Sample> samples_;
};

}  // namespace stablecut::robot
