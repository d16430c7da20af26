// The best pose at a point of the plane, among sampled redundancy angles and all branches. README.md, "Scan".
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "robot/arm_springs.h"
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
  std::array<std::optional<ScanBest>, kArms> arms;  ///< the best allowed pose of each arm
  /// The largest limit margin of all poses that reach the point, allowed or not; -infinity when none does.
  double best_limit_margin_rad = 0;
  PlanePoint most_central;  ///< the pose that has it

  std::optional<ScanBest> best() const;
};

/// Scans a task's redundancy samples. Holds references to robot and task. Thread-safe.
class PoseScanner {
 public:
  /// Throws InvalidArgument for a robot without analytic inverse kinematics or a task without a needed force.
  PoseScanner(const Robot& robot, const PoseTask& task);

  /// The best samples of a point of the plane (m). Among equal scores the pose of the largest limit margin
  /// and then the smallest turn wins, so that a redundancy that cannot matter stays where it is most
  /// comfortable.
  PointScan scan(double x, double y) const;

  /// A branch at a point: its angles and what the search needs; nothing out of reach. Limits are not looked
  /// at.
  struct Evaluation {
    JointAngles angles;
    Eigen::Matrix3d compliance;  ///< m/N, base frame
    Eigen::Isometry3d tool;      ///< base frame, m
    double score = 0;            ///< SI units
  };
  std::optional<Evaluation> evaluate(const PlanePoint& point) const;

  const Robot& robot() const { return robot_; }
  const PoseTask& task() const { return task_; }
  /// False when turning the tool about its axis cannot change the score: the tool is coaxial with joint 6,
  /// whose turn changes no compliance, and the task does not feel the tool's turn.
  bool redundancy_matters() const { return !one_compliance() || task_.stiffness.feels_tool_turn(); }
  const ArmSprings& springs() const { return springs_; }

  /// For a coaxial tool: +1 where a growing controller angle 6 makes the redundancy angle grow, else -1.
  double turn_sense() const { return turn_sense_; }

 private:
  struct Sample {
    double turn;           // redundancy angle, rad
    ArmTarget target;      // for a tool point at the base's origin
    Eigen::Matrix3d axes;  // of the tool, home frame
    ForceLoad load;        // of the task, home frame
  };
  // One sample and branch at a point.
  struct Candidate {
    double merit, limit_margin;
    int sample, branch;
  };
  template <typename Take>
  void scan_samples(const Eigen::Vector3d& point, const Take& take) const;
  template <typename Take>
  void scan_coaxial_samples(const Eigen::Vector3d& point, const Take& take) const;
  template <typename TakeAllowed>
  void for_each_allowed(double x, double y, PointScan& result, const TakeAllowed& take_allowed) const;
  /// All redundancy angles have the compliance of one.
  bool one_compliance() const { return coaxial_ && springs_.bearing6_alike(); }
  void compliances(const ArmLanes& lanes, const Eigen::Vector3d& home_point,
                   double compliance[6][kArms]) const;
  void solve(const Sample& sample, const Eigen::Vector3d& point, ArmLanes& lanes) const;
  void arm_merits(const Sample& sample, const double compliance[6][kArms], double merit[kArms]) const;
  bool any_keeps_limits(const double margin[kBranches]) const;
  bool better(const Candidate& a, const Candidate& b) const;
  ScanBest place_of(const Candidate& candidate, double x, double y) const;
  bool keeps_distance(const PlanePoint& at) const;
  std::optional<ScanBest> next_best(double x, double y, int arm) const;

  const Robot& robot_;
  const PoseTask& task_;
  InverseKinematics inverse_;
  ArmSprings springs_;
  bool coaxial_;
  double turn_sense_;
  std::vector<Sample> samples_;
};

}  // namespace stablecut::robot
