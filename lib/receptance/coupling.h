// Receptance coupling of what is joined in a row (Liu et al., eq. 6).
#pragma once

#include <Eigen/LU>

#include "receptance/beam.h"

namespace stablecut::receptance {

/// The joint between tool and holder: translational and rotational spring and damper. N/m, N s/m, N m/rad, N
/// m s/rad.
struct ToolJoint {
  double k1 = 0, c1 = 0, k2 = 0, c2 = 0;

  /// Its dynamic stiffness Kc: of the deflection, of the slope.
  Eigen::Vector2cd stiffness(double omega_rad_per_s) const {
    return {std::complex<double>(k1, omega_rad_per_s * c1), std::complex<double>(k2, omega_rad_per_s * c2)};
  }
};

/// G11 = R11 - R12 (R22 + H)^-1 R21: the tip of a free part whose end 2 is held by a part of receptance H; a
/// joint between adds its own receptance Kc^-1 to H.
template <int N>
Receptance<N> coupled_tip(const BeamReceptances& tool, const Receptance<N>& holder) {
  const Receptance<N> sum = in_all_directions<N>(tool.r22) + holder;
  return in_all_directions<N>(tool.r11) -
         in_all_directions<N>(tool.r12) * sum.inverse() * in_all_directions<N>(tool.r21);
}

/// Two free parts, the outer one's end 2 joined rigidly to the inner one's end 1.
BeamReceptances joined(const BeamReceptances& outer, const BeamReceptances& inner);

/// What held a free part, from the tip that was measured: the inverse of coupled_tip, H = R21 (R11 - G11)^-1
/// R12 - R22.
template <int N>
Receptance<N> holder_of_tip(const BeamReceptances& tool, const Receptance<N>& tip) {
  const Receptance<N> difference = in_all_directions<N>(tool.r11) - tip;
  return in_all_directions<N>(tool.r21) * difference.inverse() * in_all_directions<N>(tool.r12) -
         in_all_directions<N>(tool.r22);
}

}  // namespace stablecut::receptance
