#include "robot/stiffness_index.h"

#include <cmath>
#include <string>

#include "base/error.h"
#include "robot/force_cone.h"

namespace stablecut::robot {
namespace {

using Compliance = const Eigen::Matrix3d&;
using Tool = const Eigen::Matrix3d&;
using Force = const ForceLoad&;
using ArmCompliances = const double (*)[kArms];

// |C f|^2 of one arm.
double squared_displacement(ArmCompliances c, const Eigen::Ref<const Eigen::Vector3d>& f, int arm) {
  const double x = c[0][arm] * f[0] + c[1][arm] * f[1] + c[2][arm] * f[2];
  const double y = c[1][arm] * f[0] + c[3][arm] * f[1] + c[4][arm] * f[2];
  const double z = c[2][arm] * f[0] + c[4][arm] * f[1] + c[5][arm] * f[2];
  return x * x + y * y + z * z;
}

Eigen::Matrix3d matrix_of(ArmCompliances c, int arm) {
  Eigen::Matrix3d one;
  one << c[0][arm], c[1][arm], c[2][arm], c[1][arm], c[3][arm], c[4][arm], c[2][arm], c[4][arm], c[5][arm];
  return one;
}

// sqrt(Kx^2 + Ky^2 + Kz^2) along the tool's axes ([Yi2025, eq. 15], corrected).
double combined(Compliance compliance, Tool tool, Force) {
  double sum = 0;
  for (int i = 0; i < 3; ++i) sum += 1 / (compliance * tool.col(i)).squaredNorm();
  return std::sqrt(sum);
}
void combined_of_arms(ArmCompliances c, Tool tool, Force, double score[kArms]) {
  for (int arm = 0; arm < kArms; ++arm) {
    score[arm] = std::sqrt(1 / squared_displacement(c, tool.col(0), arm) +
                           1 / squared_displacement(c, tool.col(1), arm) +
                           1 / squared_displacement(c, tool.col(2), arm));
  }
}

// The least principal stiffness.
double weakest(Compliance compliance, Tool, Force) { return 1 / principal_compliances(compliance)[0]; }
void weakest_of_arms(ArmCompliances c, Tool, Force, double score[kArms]) {
  largest_arm_compliances(c, score);
  for (int arm = 0; arm < kArms; ++arm) score[arm] = 1 / score[arm];
}

// The stiffness along the tool axis [Yi2025, eq. 14].
double axial(Compliance compliance, Tool tool, Force) {
  return directional_stiffness(compliance, tool.col(2));
}
void axial_of_arms(ArmCompliances c, Tool tool, Force, double score[kArms]) {
  for (int arm = 0; arm < kArms; ++arm) {
    score[arm] = 1 / std::sqrt(squared_displacement(c, tool.col(2), arm));
  }
}

LargestDeflection largest_deflection(Compliance compliance, Tool tool, Force load) {
  if (load.cone_rad > 0) return largest_over_cone(compliance, load.force_n, load.cone_rad, load.smoothing);
  if (load.cut) {
    const LargestOfTurn largest =
        largest_length(compliance * load.cut_frame, load.cut->turning_n, load.smoothing);
    return {largest.length, load.cut_frame * load.cut->turning_n.col(largest.at)};
  }
  if (load.turning_n > 0)
    return largest_over_turn(compliance, load.force_n, tool.col(2), load.turning_n, load.smoothing);
  return {(compliance * load.force_n).norm(), load.force_n};
}

// The length of the displacement under the force, or the largest under those that it may be.
double deflection(Compliance compliance, Tool tool, Force load) {
  return largest_deflection(compliance, tool, load).length;
}
void deflection_of_arms(ArmCompliances c, Tool tool, Force load, double score[kArms]) {
  for (int arm = 0; arm < kArms; ++arm) {
    if (!load.varies()) {
      score[arm] = std::sqrt(squared_displacement(c, load.force_n, arm));
      continue;
    }
    score[arm] = largest_deflection(matrix_of(c, arm), tool, load).length;
  }
}

// The largest deflection of a turn along one axis of the cut's frame.
double largest_along(Compliance compliance, Force load, int axis) {
  const Eigen::RowVector3d yields = load.cut_frame.col(axis).transpose() * compliance * load.cut_frame;
  return largest_component(yields, load.cut->turning_n, load.smoothing);
}
template <int kAxis>
double along_cut(Compliance compliance, Tool, Force load) {
  return largest_along(compliance, load, kAxis);
}
template <int kAxis>
void along_cut_of_arms(ArmCompliances c, Tool, Force load, double score[kArms]) {
  for (int arm = 0; arm < kArms; ++arm) score[arm] = largest_along(matrix_of(c, arm), load, kAxis);
}

}  // namespace

std::span<const StiffnessIndex> stiffness_indices() {
  static constexpr StiffnessIndex indices[] = {
      {.name = "weakest",
       .meaning = "the least principal stiffness, N/m",
       .unit = "N/m",
       .larger_is_better = true,
       .has_ridge = true,
       .score = weakest,
       .arm_scores = weakest_of_arms},
      {.name = "combined",
       .meaning = "sqrt(Kx^2 + Ky^2 + Kz^2) along the tool's axes, N/m, not bounded near singular poses",
       .unit = "N/m",
       .larger_is_better = true,
       .feels_tool_turn = true,
       .along = {true, true, true},
       .score = combined,
       .arm_scores = combined_of_arms},
      {.name = "axial",
       .meaning = "the stiffness along the tool axis, N/m",
       .unit = "N/m",
       .larger_is_better = true,
       .along = {false, false, true},
       .score = axial,
       .arm_scores = axial_of_arms},
      {.name = "deflection",
       .meaning = "the deflection under the force, or the largest of those that it may be, um, least",
       .unit = "um",
       .units_per_score = 1e6,
       .larger_is_better = false,
       .needs_force = true,
       .score = deflection,
       .arm_scores = deflection_of_arms},
      {.name = "surface",
       .meaning = "the largest deflection normal to the wall over a turn of a cut, um, least",
       .unit = "um",
       .units_per_score = 1e6,
       .larger_is_better = false,
       .needs_force = true,
       .needs_cut = true,
       .score = along_cut<1>,
       .arm_scores = along_cut_of_arms<1>},
      {.name = "feed",
       .meaning = "the largest along its feed, um, least",
       .unit = "um",
       .units_per_score = 1e6,
       .larger_is_better = false,
       .needs_force = true,
       .needs_cut = true,
       .score = along_cut<0>,
       .arm_scores = along_cut_of_arms<0>},
  };
  return indices;
}

const StiffnessIndex& stiffness_index(std::string_view name) {
  for (const StiffnessIndex& index : stiffness_indices()) {
    if (index.name == name) return index;
  }
  throw InvalidArgument("stiffness index: " + std::string(name) + ": unknown");
}

bool StiffnessTask::feels_tool_turn() const {
  if (index->feels_tool_turn) return true;
  // A force along the tool's z axis stays where it is.
  return index->needs_force && force_in_tool && !(force_n && force_n->head<2>().isZero(0));
}

void check_force(const StiffnessTask& task) {
  if (task.index->needs_cut && !task.cut)
    throw InvalidArgument(std::string("cut: missing: expected a cut for the index ") + task.index->name);
  if (task.index->needs_force && !task.has_force())
    throw InvalidArgument(std::string("force: missing: expected a force for the index ") + task.index->name);
}

ForceLoad turned(ForceLoad load, const Eigen::Matrix3d& turn) {
  load.force_n = turn * load.force_n;
  load.cut_frame = turn * load.cut_frame;
  return load;
}

Eigen::Vector3d force_in_base(const StiffnessTask& task, const Eigen::Matrix3d& tool_rotation) {
  if (task.cut) return cut_frame(task.feed, tool_rotation.col(2)) * task.cut->mean_n;
  if (!task.force_n) throw InvalidArgument("force: missing: expected a force");
  return task.force_in_tool ? Eigen::Vector3d(tool_rotation * *task.force_n) : *task.force_n;
}

ForceLoad load_in_base(const StiffnessTask& task, const Eigen::Matrix3d& tool_rotation) {
  if (!task.has_force()) return task.load(Eigen::Vector3d::Zero());
  ForceLoad load = task.load(force_in_base(task, tool_rotation));
  if (task.cut) {
    load.cut = task.cut.get();
    load.cut_frame = cut_frame(task.feed, tool_rotation.col(2));
  }
  return load;
}

Eigen::Vector3d worst_force(const StiffnessTask& task, const Eigen::Matrix3d& compliance,
                            const Eigen::Matrix3d& tool_rotation) {
  return largest_deflection(compliance, tool_rotation, load_in_base(task, tool_rotation)).force_n;
}

double stiffness_score(const Eigen::Matrix3d& compliance, const Eigen::Matrix3d& tool_rotation,
                       const StiffnessTask& task) {
  check_force(task);
  const ForceLoad load =
      task.index->needs_force ? load_in_base(task, tool_rotation) : ForceLoad(Eigen::Vector3d::Zero());
  return task.index->score(compliance, tool_rotation, load);
}

double smooth_score(const Eigen::Matrix3d& compliance, const Eigen::Matrix3d& tool_rotation,
                    const StiffnessTask& task, double power) {
  if (task.index->has_ridge) {
    const Eigen::Vector3d compliances = principal_compliances(compliance);
    const double mean =
        std::pow((compliances / compliances[0]).cwiseMax(0.0).array().pow(power).sum(), 1 / power);
    return stiffness_score(compliance, tool_rotation, task) / mean;
  }
  ForceLoad load = load_in_base(task, tool_rotation);
  load.smoothing = 1 / power;
  return task.index->score(compliance, tool_rotation, load);
}

}  // namespace stablecut::robot
