// What every point of a path offers: rungs of the redundancy, branches and copies of the angles by whole
// turns. README.md, "Paths".
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/units.h"
#include "robot/arm_springs.h"
#include "robot/path_task.h"

namespace stablecut::robot {

/// Turns of the tool at each point of the path: turn base[i] + k step, k = 0 ... rungs - 1.
struct Ladder {
  std::vector<double> base;  ///< rad
  double step = 0;           ///< rad
  int rungs = 0;
  bool closed = false;  ///< a full turn: after the last rung comes the first

  double turn(std::size_t point, int rung) const { return base[point] + rung * step; }
};

/// The whole-turn copies of a joint's angle that its range can hold, numbered together.
inline constexpr int kMostCopies = 32;
struct AngleCopies {
  static constexpr int kMostEach = 3;
  std::array<int, kJoints> count;                           ///< at most kMostEach
  std::array<int, kJoints> stride;                          ///< of the joint's copy in the common number
  std::array<double, kJoints> least_rad;                    ///< copy 0 is from here to a turn further
  int combinations = 1;                                     ///< at most kMostCopies
  std::array<std::array<int, kJoints>, kMostCopies> turns;  ///< [common number][joint]
  /// [joint][n] bits of the common numbers in which the joint is in one of its first n copies.
  std::array<std::array<std::uint32_t, kMostEach + 1>, kJoints> within;
};

/// One branch at one point.
struct BranchRungs {
  std::array<std::vector<double>, kJoints> angle;  ///< [rung] rad, of copy 0
  std::vector<double> cost;                        ///< [rung] path_cost(); infinite where nothing is allowed
  std::vector<std::uint32_t> copies;               ///< [rung] a bit for each copy that is allowed
  bool any = false;                                ///< of the rungs is allowed

  JointAngles at(int rung) const {
    return (JointAngles() << angle[0][rung], angle[1][rung], angle[2][rung], angle[3][rung], angle[4][rung],
            angle[5][rung])
        .finished();
  }
};
inline constexpr unsigned kAllBranches = 0xFF;
using PointRungs = std::array<BranchRungs, kBranches>;

/// The least cost of a point by itself; infinite where nothing is allowed.
double least_cost(const PointRungs& rungs);

/// The step of the ladders that paths are searched on, rad.
inline constexpr double kLadderStep = kPi / 180;

/// The least cost of each rung of a ladder over all branches, as far as it is known: what a later pass over
/// the same ladder need not solve again.
class RungCosts {
 public:
  explicit RungCosts(std::size_t points, int rungs)
      : rungs_(static_cast<std::size_t>(rungs)), least_(points * rungs_, -1.0F) {}

  void store(std::size_t point, int rung, double cost) { least_[at(point, rung)] = static_cast<float>(cost); }
  /// Known to cost more than that, or not to be allowed where that is infinite.
  bool costs_more(std::size_t point, int rung, double most_cost) const {
    const float least = least_[at(point, rung)];
    return std::isinf(least) || least > most_cost * (1 + kFloatRounding);
  }

 private:
  static constexpr double kFloatRounding = 1e-6;

  std::size_t at(std::size_t point, int rung) const {
    return point * rungs_ + static_cast<std::size_t>(rung);
  }

  std::size_t rungs_;
  std::vector<float> least_;
};

/// What the joints and the tool may turn in the move that leads to a point, rad.
struct StepLimit {
  JointAngles joint;
  double turn = 0;
};

/// Why a pose is not allowed.
struct PoseFault {
  enum class Kind { kNone, kReach, kRedundancy, kLimit, kSingularity, kKeepOut };
  Kind kind = Kind::kNone;
  int joint = 0;       ///< of kLimit
  double missing = 0;  ///< by how much: rad, m; of the singularity margin in its unit
};

/// Robot and task, ready to be asked. Holds references to both. Thread-safe.
class PathModel {
 public:
  /// Throws InvalidArgument for a robot without analytic inverse kinematics, an empty path or a missing
  /// force.
  PathModel(const Robot& robot, const PathTask& task);

  /// All rungs of the branches (bits) at a point. `known`, of the same ladder: rungs that are known to cost
  /// more than `most_cost` may be left out, and what all branches cost is stored.
  void fill(const Ladder& ladder, std::size_t point, unsigned branches, PointRungs& rungs,
            RungCosts* known = nullptr, double most_cost = std::numeric_limits<double>::infinity()) const;

  /// The angles of a branch at a turn, in that copy. The turn must be within reach.
  JointAngles angles(std::size_t point, double turn, int branch, int copy) const;
  /// The same of copy 0 and limits aside, and what the pose costs; nothing out of reach.
  struct Pose {
    JointAngles angles;
    double cost = 0;
  };
  std::optional<Pose> pose(std::size_t point, double turn, int branch) const;
  /// The rule that a branch's pose breaks, in the copies of its angles that are most central; that of a pose
  /// at that turn with those angles.
  PoseFault fault(std::size_t point, double turn, int branch) const;
  PoseFault fault_of(std::size_t point, double turn, const JointAngles& angles) const;

  /// The full turn in steps of about `step`, or the task's interval.
  Ladder whole_ladder(double step) const;
  /// Of every move; 0 for the first point.
  std::vector<StepLimit> step_limits() const;

  const Robot& robot() const { return robot_; }
  const PathTask& task() const { return task_; }
  const PathFrames& frames() const { return frames_; }
  const AngleCopies& copies() const { return copies_; }
  std::size_t size() const { return task_.path.size(); }

 private:
  ArmTarget target(std::size_t point, double turn, Eigen::Matrix3d& axes) const;
  bool in_interval(std::size_t point, double turn) const;
  void take_branch(const ArmLanes& lanes, int branch, int rung, double cost, BranchRungs& rungs) const;
  void store_lowest(const ArmLanes& lanes, int branch, double angles[kJoints]) const;
  JointAngles copy_of(const double angles[kJoints], int copy) const;
  std::uint32_t allowed_copies(const double angles[kJoints]) const;
  void costs(const ArmLanes& lanes, std::size_t point, const Eigen::Matrix3d& axes, double cost[kArms]) const;

  const Robot& robot_;
  const PathTask& task_;
  InverseKinematics inverse_;
  ArmSprings springs_;
  PathFrames frames_;
  AngleCopies copies_;
  bool coupled_copies_;          // any joint that has copies follows another or is followed
  std::vector<ForceLoad> load_;  // home frame, of each point; the force in the tool's frame where it is that
  std::vector<Eigen::Vector3d> home_point_;  // the tool point, home frame
};

}  // namespace stablecut::robot
