// --cut: the forces of a cut, for how the robot yields under them.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>

#include "cli/tool.h"
#include "robot/stiffness_index.h"

namespace stablecut {

/// As the options give it.
struct CutOptions {
  std::string path;
  std::optional<double> depth_mm;
  std::optional<std::array<double, 3>> feed;

  bool given() const { return !path.empty(); }
};

/// Declares what belongs to --cut (a file) beside it.
void add_cut_options(CLI::App& app, CutOptions& options);

/// Throws WrongUsage where something is missing or too much.
void check_cut_options(const CutOptions& options, bool along_path);

/// The task with the forces of that cut document. Throws DataError and WrongUsage.
void take_cut(const document::Input& input, const CutOptions& options, robot::StiffnessTask& task);

/// Throws WrongUsage where a task has a cut whose feed runs along this tool axis, of the pose that `whose`
/// names.
void check_feed(const robot::StiffnessTask& task, const Eigen::Vector3d& tool_axis, const std::string& whose);

}  // namespace stablecut
