// What holds a known part, from taps along it: inverse receptance coupling.
#pragma once

#include <map>
#include <vector>

#include "receptance/held_tool.h"
#include "receptance/taps.h"

namespace stablecut::receptance {

/// A known free part at one angular frequency (rad/s).
class Artefact {
 public:
  Artefact(const BeamChain& chain, BeamTheory theory, double omega)
      : chain_(chain), theory_(theory), omega_(omega) {}

  /// Between its ends.
  BeamReceptances ends() const { return free_chain(chain_, theory_, omega_); }
  /// Deflection at a place per force at another, distances from the tip.
  std::complex<double> between(double a, double b) const {
    return free_receptance_along(chain_, theory_, omega_, a, b)(0, 0);
  }
  /// Deflection at a place per force and moment at its end 2.
  Eigen::RowVector2cd to_joint(double a) {
    const auto found = to_joint_.find(a);
    if (found != to_joint_.end()) return found->second;
    return to_joint_[a] = free_response_to_end(chain_, theory_, omega_, a).row(0);
  }

 private:
  const BeamChain& chain_;
  BeamTheory theory_;
  double omega_;
  std::map<double, Eigen::RowVector2cd> to_joint_;
};

/// (R22 + H)^-1 between two directions, and on the diagonal of directions, where it is symmetric, the
/// covariance of Y11, Y12 and Y22.
struct Inverse {
  Receptance<2> value = Receptance<2>::Zero();
  Eigen::MatrixXcd covariance;
};

/// From taps along the part at one line, weighted least squares: G_ab = R_ab - r_a Y r_b is linear in Y (3
/// unknowns where it is symmetric, else 4 and no R_ab). Throws InvalidArgument where the taps are too alike.
Inverse inverse_of(const std::vector<const Tap*>& taps, Artefact& artefact, bool symmetric,
                   Eigen::Index line);

}  // namespace stablecut::receptance
