// Receptances of beams in bending: a uniform segment, free at both ends or fixed at one (Liu et al., Table 1
// and eqs. 7 to 9, generalised to Timoshenko's beam and freed of cancellation).
#pragma once

#include <Eigen/Core>
#include <complex>

namespace stablecut::receptance {

/// Deflection (m) and slope (rad) per force (N) and moment (N m), in one direction (N = 2: [[h, l], [n, p]])
/// or in x and y (N = 4: w_x, slope_x, w_y, slope_y). The slope is d(deflection)/ds with s from the joint
/// (end 2) towards the tip (end 1), a moment acts in its sense. In Timoshenko's theory the slope is the
/// rotation of the section.
template <int N>
using Receptance = Eigen::Matrix<std::complex<double>, N, N>;

enum class BeamTheory { kEulerBernoulli, kTimoshenko };

/// A round bar or tube of one material.
struct BeamSegment {
  double length_m = 0;
  double outer_diameter_m = 0;
  double inner_diameter_m = 0;
  double youngs_modulus_pa = 0;
  double density_kg_per_m3 = 0;
  double poisson_ratio = 0.3;
  double loss_factor = 0;  ///< structural damping: E and G become E (1 + i eta), G (1 + i eta)
};

/// Of a free part, in one direction: between its ends 1 (tip) and 2 (joint).
struct BeamReceptances {
  Receptance<2> r11, r12, r21, r22;
};

/// The same in each of the N / 2 directions, which a round part does not couple.
template <int N>
Receptance<N> in_all_directions(const Receptance<2>& one) {
  if constexpr (N == 2) {
    return one;
  } else {
    Receptance<4> all = Receptance<4>::Zero();
    all.template topLeftCorner<2, 2>() = all.template bottomRightCorner<2, 2>() = one;
    return all;
  }
}

/// Shear coefficient after Cowper of a round section or tube.
double cowper_shear_coefficient(double inner_over_outer_diameter, double poisson_ratio);

/// A segment at an angular frequency above 0 (rad/s). Relative error about 1e-13 from the rigid body to many
/// waves. Throws InvalidArgument for sizes or frequencies that are not above 0.
class SegmentMotion {
 public:
  SegmentMotion(const BeamSegment& segment, BeamTheory theory, double omega_rad_per_s);

  /// Free at both ends.
  BeamReceptances free() const;

  /// The receptance at end 1 when end 2 is held by a part of receptance `holder` (zero: fixed). Where the
  /// segment is short for its waves this does not pass through its own rigid body, and so does not cancel. N
  /// is 2 or 4.
  template <int N>
  Receptance<N> held(const Receptance<N>& holder) const;

 private:
  // What end 1 does and takes for what end 2 does and takes, where the segment is short; else how it moves
  // free.
  struct Transfer {
    Receptance<2> movement_of_movement, movement_of_load, load_of_movement, load_of_load;
  };
  bool short_;
  Transfer transfer_;
  BeamReceptances free_;
};

}  // namespace stablecut::receptance
