// Receptance coupling of parts in a row [Liu2014, eq. 6] [Schmitz2000], and its inverse. README.md,
// section 5.
#pragma once

#include <Eigen/LU>

#include "receptance/beam.h"

namespace stablecut::receptance {

/// The joint between tool and holder: a spring and a damper against relative deflection (k1 in N/m, c1 in
/// N s/m) and another pair against relative rotation (k2 in N m/rad, c2 in N m s/rad).
struct ToolJoint {
  double k1 = 0, c1 = 0, k2 = 0, c2 = 0;

  bool operator==(const ToolJoint&) const = default;

  /// Its dynamic stiffness, the diagonal of Kc: (k1 + i w c1, k2 + i w c2).
  Eigen::Vector2cd stiffness(double omega_rad_per_s) const {
    return {std::complex<double>(k1, omega_rad_per_s * c1), std::complex<double>(k2, omega_rad_per_s * c2)};
  }
};

/// End 1 of a free part whose end 2 is held by a part of receptance H: G11 = R11 - R12 (R22 + H)^-1 R21
/// [Liu2014, eq. 6]. A joint between the two adds its own receptance Kc^-1 to H.
template <int N>
Receptance<N> coupled_tip(const BeamReceptances& tool, const Receptance<N>& holder) {
  const Receptance<N> sum = in_all_directions<N>(tool.r22) + holder;
  return in_all_directions<N>(tool.r11) -
         in_all_directions<N>(tool.r12) * sum.inverse() * in_all_directions<N>(tool.r21);
}

/// The one free part that two make when the outer one's end 2 is joined rigidly to the inner one's end 1.
BeamReceptances rigidly_coupled(const BeamReceptances& outer, const BeamReceptances& inner);

/// The same part seen from its other end: ends 1 and 2 change places, and with s every slope and moment its
/// sign.
BeamReceptances turned_round(const BeamReceptances& part);

/// The inverse of coupled_tip: the receptance H of what holds a free part, from the receptance G11 that was
/// measured at its end 1, H = R21 (R11 - G11)^-1 R12 - R22.
template <int N>
Receptance<N> holder_of_tip(const BeamReceptances& tool, const Receptance<N>& tip) {
  const Receptance<N> difference = in_all_directions<N>(tool.r11) - tip;
  return in_all_directions<N>(tool.r21) * difference.inverse() * in_all_directions<N>(tool.r12) -
         in_all_directions<N>(tool.r22);
}

}  // namespace stablecut::receptance
