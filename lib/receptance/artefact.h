// What holds a known part, from taps along it: inverse receptance coupling [Park2003] [Kumar2012]. README.md,
// section 8.
#pragma once

#include <map>
#include <vector>

#include "receptance/held_tool.h"
#include "receptance/taps.h"

namespace stablecut::receptance {

/// A known free part at one angular frequency (rad/s): end 1 is its tip, end 2 stands on the holder. The
/// chain must outlive it.
class Artefact {
 public:
  Artefact(const BeamChain& chain, BeamTheory theory, double omega)
      : chain_(chain), theory_(theory), omega_(omega) {}

  BeamReceptances ends() const { return free_chain(chain_, theory_, omega_); }
  /// Deflection at one place per force at another, distances from the tip.
  std::complex<double> receptance(double response_m, double reference_m) const {
    return free_receptance_along(chain_, theory_, omega_, response_m, reference_m)(0, 0);
  }
  /// Deflection at a place per force and per moment at end 2. Computed once for each place.
  Eigen::RowVector2cd response_to_end_2(double place_m) {
    const auto found = response_to_end_2_.find(place_m);
    if (found != response_to_end_2_.end()) return found->second;
    return response_to_end_2_[place_m] = free_response_to_end(chain_, theory_, omega_, place_m).row(0);
  }

 private:
  const BeamChain& chain_;
  BeamTheory theory_;
  double omega_;
  std::map<double, Eigen::RowVector2cd> response_to_end_2_;
};

/// The stiffness Y = (R22 + H)^-1 against an opening between artefact and holder, one 2 x 2 block of it.
struct OpeningStiffness {
  Receptance<2> value = Receptance<2>::Zero();
  Eigen::MatrixXcd covariance;  ///< of Y11, Y12 and Y22; empty for a block between x and y
};

/// The block from taps along the artefact at one line, by weighted least squares: with the artefact's free
/// receptance R_ab and responses r_a, r_b to loads at its end 2, a tap is G_ab = R_ab - r_a Y r_b^T, linear
/// in Y. In one direction (`symmetric`) Y has 3 unknowns; between x and y it has 4, and R_ab is 0. Throws
/// InvalidArgument where the taps' places are too few or too near each other to tell the unknowns apart.
OpeningStiffness opening_stiffness(const std::vector<const Tap*>& taps, Artefact& artefact, bool symmetric,
                                   Eigen::Index line);

}  // namespace stablecut::receptance
