// The values of rcsa-couple's own options.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "receptance/held_tool.h"
#include "receptance/joint_identification.h"

namespace stablecut {

/// Names of the joint's values, in the order of JointValues.
inline constexpr std::array<const char*, 4> kJointNames = {"k1", "c1", "k2", "c2"};

/// Adds the places of `--positions MM,MM,...`, in metres. Throws WrongUsage.
void add_positions(const std::string& text, std::vector<double>& positions_m);

/// Sets the bounds of `--bounds NAME=LO:HI,...`. Throws WrongUsage.
void set_bounds(const std::string& text, receptance::JointBounds& bounds);

/// Gives a tool (tip to joint) another length by that of its segment at the joint. Throws WrongUsage where
/// the segments before it are as long as that already.
void set_overhang(double overhang_mm, receptance::BeamChain& tool);

}  // namespace stablecut
