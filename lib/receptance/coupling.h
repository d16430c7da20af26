// Receptance coupling of what is joined in a row (Liu et al., eq. 6).
#pragma once

#include "receptance/beam.h"

namespace stablecut {

/// The joint between tool and holder: translational and rotational spring and damper. N/m, N s/m, N m/rad, N
/// m s/rad.
struct ToolJoint {
  double k1 = 0, c1 = 0, k2 = 0, c2 = 0;

  /// The joint's own receptance, Kc^-1.
  Eigen::Matrix2cd receptance(double omega_rad_per_s) const;
};

/// G11 = R11 - R12 (R22 + H)^-1 R21: the tip of a free part whose end 2 is held by a part of receptance H; a
/// joint between adds its own receptance to H.
Eigen::Matrix2cd coupled_tip(const BeamReceptances& tool, const Eigen::Matrix2cd& holder);

}  // namespace stablecut
