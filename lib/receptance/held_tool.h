// A tool in its holder at one frequency: the tip, and what the joint between them does to it.
#pragma once

#include <vector>

#include "receptance/coupling.h"

namespace stablecut::receptance {

/// A part of segments in a row, outermost first, joined rigidly.
using BeamChain = std::vector<BeamSegment>;

/// The chain's outer end when its inner end is held by a part of receptance `inner` (zero: fixed). An empty
/// chain gives `inner` back. Carried from the inner end outwards: exact also where the parts are short.
/// Throws InvalidArgument for sizes or frequencies that are not above 0, as all of these do.
template <int N>
Receptance<N> held_chain(const BeamChain& chain, BeamTheory theory, double omega_rad_per_s,
                         const Receptance<N>& inner);

/// The chain free at both ends. Needs a segment.
BeamReceptances free_chain(const BeamChain& chain, BeamTheory theory, double omega_rad_per_s);

/// Tool and holder as their joint sees them. For a load F at the tip and an opening g of the joint,
///   tip = rigid_tip F + of_opening g,   load through the joint = transmitted F - stiffness g,
/// so that a joint of stiffness Kc gives the tip rigid_tip + of_opening (Kc + stiffness)^-1 transmitted. It
/// is eq. 6 with (R22 + H + Kc^-1)^-1 split into what does not depend on the joint and what does; nothing
/// cancels at low frequency.
template <int N>
struct JointPlane {
  Receptance<N> rigid_tip, of_opening, transmitted, stiffness;

  Receptance<N> tip(const Eigen::Matrix<std::complex<double>, N, 1>& joint_stiffness) const {
    Receptance<N> sum = stiffness;
    sum.diagonal() += joint_stiffness;
    return rigid_tip + of_opening * sum.inverse() * transmitted;
  }
};

/// `holder`: what holds the joint from within. Throws InvalidArgument where there is no segment.
template <int N>
JointPlane<N> joint_plane(const BeamChain& tool, BeamTheory theory, double omega_rad_per_s,
                          const Receptance<N>& holder);

/// The same with a mass on the tip: a sensor.
template <int N>
JointPlane<N> with_tip_mass(const JointPlane<N>& plane, double mass_kg, double omega_rad_per_s);

/// A mass (kg) added to a place, which a sensor does, or with a minus taken away: (G^-1 - w^2 M)^-1.
template <int N>
Receptance<N> with_mass(const Receptance<N>& at, double mass_kg, double omega_rad_per_s);

/// Receptance between two places on a held tool, distances from the tip: movement at `response_m` per load at
/// `reference_m`. Throws InvalidArgument for places that are not on the tool.
template <int N>
Receptance<N> receptance_along(const BeamChain& tool, BeamTheory theory, double omega_rad_per_s,
                               const Receptance<N>& holder, double response_m, double reference_m);

/// Movement at a place on a free tool per load at its end 2. Throws InvalidArgument for places that are not
/// on it.
Receptance<2> free_response_to_end(const BeamChain& tool, BeamTheory theory, double omega_rad_per_s,
                                   double response_m);

/// Receptance between two places on a free tool. Throws InvalidArgument for places that are not on it.
Receptance<2> free_receptance_along(const BeamChain& tool, BeamTheory theory, double omega_rad_per_s,
                                    double response_m, double reference_m);

}  // namespace stablecut::receptance
