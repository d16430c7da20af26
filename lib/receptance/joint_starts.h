// Where to begin a search for the joint: starts that do not miss.
#pragma once

#include <vector>

#include "receptance/tip_line.h"

namespace stablecut::receptance {

struct JointStart {
  ToolJoint joint;
  double cost = 0;
};

/// Within the bounds.
ToolJoint within(const ToolJoint& joint, const JointBounds& bounds);

/// The cheapest that differ in stiffness by a fifth or more, cheapest first; at most that many.
std::vector<JointStart> best_of(std::vector<JointStart> all, std::size_t most);

/// Good joints on some of the lines, best first. With y = H - rigid and K2 known, eq. 6 is linear in K1 = k1
/// + i w c1, and the other way round: one stiffness is scanned and the other solved for; the best pairs are
/// then solved for in turns.
std::vector<JointStart> joint_starts(const TipLines& lines, const JointBounds& bounds,
                                     JointObjective objective);

}  // namespace stablecut::receptance
