// Where to begin a search for the joint, so that the best one is not missed. README.md, section 12.
#pragma once

#include <vector>

#include "receptance/tip_line.h"

namespace stablecut::receptance {

/// A joint and its objective.
struct JointCandidate {
  ToolJoint joint;
  double cost = 0;
};

/// Each value moved to the nearer bound where it lies outside.
ToolJoint clamped(const ToolJoint& joint, const JointBounds& bounds);

/// At most `most` of the candidates, cheapest first; of candidates with nearly the same k1 and k2 only the
/// cheapest.
std::vector<JointCandidate> best_distinct(std::vector<JointCandidate> all, std::size_t most);

/// Good joints on some of the lines, cheapest first: one stiffness is scanned over its bounds while the other
/// is solved for, which is linear least squares [Sanathanan1963] [Soderstrom1983]; the best are then improved
/// by solving for both in turns.
std::vector<JointCandidate> joint_starts(const TipLines& lines, const JointBounds& bounds,
                                         JointObjective objective);

}  // namespace stablecut::receptance
