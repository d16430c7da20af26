// A tool in a holder: its receptance at the tip.
#pragma once

#include <optional>
#include <vector>

#include "receptance/coupling.h"

namespace stablecut {

/// One direction's holder and joint.
struct HeldTool {
  std::vector<BeamSegment> holder;  ///< from the joint inwards, joined rigidly
  bool holder_fixed = true;         ///< its inner end; else free
  std::optional<ToolJoint> joint;   ///< none: rigid
};

/// [[h, l], [n, p]] at the tip (end 1) of a free tool of segments from the tip to the joint, joined rigidly,
/// in its holder. Throws InvalidArgument where a segment or frequency is not above 0 or there is no segment.
Eigen::Matrix2cd tip_receptance(const std::vector<BeamSegment>& tool, const HeldTool& held, BeamTheory theory,
                                double omega_rad_per_s);

}  // namespace stablecut
