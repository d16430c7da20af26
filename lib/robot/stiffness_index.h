// What a pose is judged by: the table of the stiffness indices. README.md, "Stiffness indices", says how an
// index is added.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string_view>

#include "robot/arm_lanes.h"
#include "robot/compliance.h"
#include "robot/cut_load.h"

namespace stablecut::robot {

/// The force on the tool point, and how it may differ from what is known.
struct ForceLoad {
  Eigen::Vector3d force_n;
  double cone_rad = 0;   ///< it may point anywhere within this angle (at most pi/2) of force_n
  double turning_n = 0;  ///< beside it a force of this size turns about the tool axis, square to it
  double smoothing = 0;  ///< of the kink where two of these forces tie: largest_over_turn()
  /// The forces that act are those of a cut, in this frame (columns); force_n is their mean.
  const CutLoad* cut = nullptr;
  Eigen::Matrix3d cut_frame = Eigen::Matrix3d::Identity();

  template <typename Derived>
  ForceLoad(const Eigen::MatrixBase<Derived>& force) : force_n(force) {}
  ForceLoad(const Eigen::Vector3d& force, double cone, double turning)
      : force_n(force), cone_rad(cone), turning_n(turning) {}
  bool varies() const { return cone_rad > 0 || turning_n > 0 || cut; }
};

/// The same load in another frame, into which `turn` takes directions.
ForceLoad turned(ForceLoad load, const Eigen::Matrix3d& turn);

/// One way to judge how stiff a pose is, from the compliance C_tt of the tool point, the directions of the
/// tool's axes and perhaps a force. A score is above 0, in SI units.
struct StiffnessIndex {
  const char* name;            ///< in options and documents
  const char* meaning;         ///< for a help text
  const char* unit;            ///< of the score in a document
  double units_per_score = 1;  ///< of that unit in one SI unit of the score

  bool larger_is_better;
  bool needs_force = false;  ///< the score is that of the task's force
  bool needs_cut = false;    ///< and that is a cut's
  /// The score changes when the tool turns about its own z axis while the compliance stays. (A force that is
  /// given in the tool's frame is looked after by StiffnessTask.)
  bool feels_tool_turn = false;
  /// The tool's axes along which the index takes a stiffness. Where the arm cannot yield along one of them
  /// that stiffness is infinite and the pose has no score.
  std::array<bool, 3> along{};
  /// The score is the largest eigenvalue's: not smooth where the two largest principal compliances are equal.
  bool has_ridge = false;

  /// The score: `compliance` m/N, `tool` with the tool's axes as columns and `force` N, all in one frame.
  double (*score)(const Eigen::Matrix3d& compliance, const Eigen::Matrix3d& tool, const ForceLoad& load);
  /// The same for four arms from the entries of their compliances, as arm_compliances() gives them: what the
  /// scan calls, millions of times.
  void (*arm_scores)(const double compliance[6][kArms], const Eigen::Matrix3d& tool, const ForceLoad& load,
                     double score[kArms]);
};

/// All of them; the first is the default.
std::span<const StiffnessIndex> stiffness_indices();

/// The index of that name. Throws InvalidArgument for an unknown name.
const StiffnessIndex& stiffness_index(std::string_view name);

/// An index with what it needs to be told.
struct StiffnessTask {
  const StiffnessIndex* index = &stiffness_indices().front();
  std::optional<Eigen::Vector3d> force_n;  ///< on the tool point
  bool force_in_tool = false;              ///< the force is given in the tool's frame, else in the base's
  double force_cone_rad = 0;               ///< ForceLoad::cone_rad; one of the two at most
  double force_turning_n = 0;              ///< ForceLoad::turning_n
  /// The forces of a cut instead of force_n, and the direction of its feed, base frame.
  std::shared_ptr<const CutLoad> cut;
  Eigen::Vector3d feed = Eigen::Vector3d::UnitX();

  /// False when the score cannot change as the tool turns about its own axis while the compliance stays.
  bool feels_tool_turn() const;
  bool has_force() const { return force_n || cut; }
  /// The load of a force in whatever frame, without a cut.
  ForceLoad load(const Eigen::Vector3d& force) const { return {force, force_cone_rad, force_turning_n}; }
  /// The score is the largest of several: not smooth where two tie.
  bool has_kink() const {
    return index->has_ridge || (index->needs_force && (force_cone_rad > 0 || force_turning_n > 0 || cut));
  }
};

/// Throws InvalidArgument when the index needs a force or a cut and the task has none.
void check_force(const StiffnessTask& task);

/// The task's force in the base frame, N, for a tool of that orientation (its axes in the base frame); of a
/// cut its mean. Throws InvalidArgument when the task has none.
Eigen::Vector3d force_in_base(const StiffnessTask& task, const Eigen::Matrix3d& tool_rotation);

/// The same with what the force may be; no force where the task has none.
ForceLoad load_in_base(const StiffnessTask& task, const Eigen::Matrix3d& tool_rotation);

/// The force with which the deflection is largest, in the base frame, N: that of force_in_base() where the
/// force does not vary.
Eigen::Vector3d worst_force(const StiffnessTask& task, const Eigen::Matrix3d& compliance,
                            const Eigen::Matrix3d& tool_rotation);

/// The score by the task's index, in SI units; `compliance` in the base frame, m/N. Throws InvalidArgument
/// when the index needs a force and the task has none.
double stiffness_score(const Eigen::Matrix3d& compliance, const Eigen::Matrix3d& tool_rotation,
                       const StiffnessTask& task);

/// The same without kinks where has_kink(): the largest principal compliance as the mean of power P of all,
/// or of a force that varies with smoothing 1 / P. Not better than the score, and no worse by more than about
/// 1 / P; of a cut log(n) / P, with n forces that nearly tie.
double smooth_score(const Eigen::Matrix3d& compliance, const Eigen::Matrix3d& tool_rotation,
                    const StiffnessTask& task, double power);

}  // namespace stablecut::robot
