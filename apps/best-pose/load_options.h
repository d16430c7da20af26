// The force on the tool point and the index that judges it, as the options give them.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "cli/tool.h"
#include "robot/stiffness_index.h"

namespace stablecut {

struct LoadOptions {
  std::string index, frame;
  std::optional<std::array<double, 3>> force_n;
  std::optional<double> cone_deg, turning_n;
};

void add_load_options(CLI::App& app, LoadOptions& options);

/// The task that they make; `along_path`: a path, whose index is the deflection where there is a force;
/// `with_cut`: a cut will give the force, and the index is what of the deflection shows on the wall. Throws
/// WrongUsage.
robot::StiffnessTask stiffness_task(const LoadOptions& options, bool along_path, bool with_cut);

}  // namespace stablecut
