// A stepped tool in its holder at one frequency: its tip, places along it, and how the tip depends on the
// joint [Schmitz2005]. README.md, sections 4 to 6.
#pragma once

#include <vector>

#include "receptance/coupling.h"

namespace stablecut::receptance {

/// Segments in a row, outermost first, joined rigidly.
using BeamChain = std::vector<BeamSegment>;

/// Places on a chain that differ by less than this share of a length are one place.
inline constexpr double kPlaceRounding = 1e-12;

/// Sum of the segments' lengths, m.
double length_of(const BeamChain& chain);

/// The receptance of the chain's outer end when its inner end is held by a part of receptance `inner` (zero:
/// fixed), segment by segment from the inner end outwards; accurate also where segments are short. An empty
/// chain gives `inner` back. As all functions here it throws InvalidArgument for sizes or frequencies that
/// are not above 0.
template <int N>
Receptance<N> held_chain(const BeamChain& chain, BeamTheory theory, double omega_rad_per_s,
                         const Receptance<N>& inner);

/// The chain free at both ends. Throws InvalidArgument for an empty chain.
BeamReceptances free_chain(const BeamChain& chain, BeamTheory theory, double omega_rad_per_s);

/// Tool and holder cut at the joint. Let F be a load at the tip and g the opening of the joint: deflection
/// and slope of the tool's end less those of the holder's face. Then
///   movement of the tip = rigid_tip F + of_opening g,
///   load from tool to holder = transmitted F - stiffness g.
/// A joint of dynamic stiffness Kc passes on the load Kc g, which makes the tip
/// rigid_tip + of_opening (Kc + stiffness)^-1 transmitted: [Liu2014, eq. 6] with (R22 + H + Kc^-1)^-1 divided
/// into what does not depend on the joint and what does (README.md, section 6).
template <int N>
struct JointPlane {
  Receptance<N> rigid_tip, of_opening, transmitted, stiffness;

  Receptance<N> tip(const Eigen::Matrix<std::complex<double>, N, 1>& joint_stiffness) const {
    Receptance<N> sum = stiffness;
    sum.diagonal() += joint_stiffness;
    return rigid_tip + of_opening * sum.inverse() * transmitted;
  }
};

/// `holder`: receptance of the holder's face. Throws InvalidArgument for a tool without a segment.
template <int N>
JointPlane<N> joint_plane(const BeamChain& tool, BeamTheory theory, double omega_rad_per_s,
                          const Receptance<N>& holder);

/// The same tool with a mass on its tip: an accelerometer.
template <int N>
JointPlane<N> with_tip_mass(const JointPlane<N>& plane, double mass_kg, double omega_rad_per_s);

/// The receptance at a place after a mass (kg) was added there: (G^-1 - w^2 M)^-1. A negative mass takes a
/// sensor away [Cakar2005].
template <int N>
Receptance<N> with_mass(const Receptance<N>& at, double mass_kg, double omega_rad_per_s);

/// Movement at `response_m` per load at `reference_m` on a held tool, both distances from its tip. Throws
/// InvalidArgument for places that are not on the tool.
template <int N>
Receptance<N> receptance_along(const BeamChain& tool, BeamTheory theory, double omega_rad_per_s,
                               const Receptance<N>& holder, double response_m, double reference_m);

/// Movement at a place on a free tool, `response_m` from its tip, per load at its end 2. Throws
/// InvalidArgument for places that are not on it.
Receptance<2> free_response_to_end(const BeamChain& tool, BeamTheory theory, double omega_rad_per_s,
                                   double response_m);

/// Movement at `response_m` per load at `reference_m` on a free tool. Throws InvalidArgument for places that
/// are not on it.
Receptance<2> free_receptance_along(const BeamChain& tool, BeamTheory theory, double omega_rad_per_s,
                                    double response_m, double reference_m);

}  // namespace stablecut::receptance
