// Receptance coupling of what is joined in a row (Liu et al., eq. 6).
#pragma once

#include <optional>

#include "receptance/beam.h"

namespace stablecut {

/// The joint between tool and holder: translational and rotational spring and damper. N/m, N s/m, N m/rad, N
/// m s/rad.
struct ToolJoint {
  double k1 = 0, c1 = 0, k2 = 0, c2 = 0;

  /// The joint's own receptance, Kc^-1.
  Eigen::Matrix2cd receptance(double omega_rad_per_s) const;
};

/// Two free parts joined rigidly: `outer`'s end 2 to `inner`'s end 1.
BeamReceptances joined(const BeamReceptances& outer, const BeamReceptances& inner);

/// G11 = R11 - R12 (R22 + H + J)^-1 R21: the tip of a free part whose end 2 is held by a holder of receptance
/// H, through a joint of receptance J (none: rigidly).
Eigen::Matrix2cd coupled_tip(const BeamReceptances& tool, const Eigen::Matrix2cd& holder,
                             const std::optional<Eigen::Matrix2cd>& joint = std::nullopt);

}  // namespace stablecut
