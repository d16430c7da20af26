// What tool and links keep out of: the options, and what they make of the robot's document.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/tool.h"
#include "robot/robot.h"

namespace stablecut {

struct KeepOutOptions {
  std::optional<double> radius_mm, floor_mm;
  std::vector<robot::Box> boxes;
};

void add_keep_out_options(CLI::App& app, KeepOutOptions& options);

/// Puts them into the robot: the radius of the option, else the document's, else the least that its own
/// dimensions say.
void apply(const KeepOutOptions& options, robot::Robot& robot);

}  // namespace stablecut
