// Receptances of a uniform beam segment in bending, free at both ends or held at one: [Liu2014, Table 1 and
// eqs. 7 to 9], extended to Timoshenko's beam [Timoshenko1921] and written so that nothing cancels.
// README.md, sections 2 to 4.
#pragma once

#include <Eigen/Core>
#include <array>
#include <complex>

namespace stablecut::receptance {

/// Deflection (m) and slope (rad) per force (N) and moment (N m), in one direction (N = 2: [[h, l], [n, p]])
/// or in x and y (N = 4, in the order w_x, slope_x, w_y, slope_y). The slope is d(deflection)/ds with s from
/// the joint (end 2) towards the tip (end 1); a positive moment does work on a positive slope. In
/// Timoshenko's theory the slope is the rotation of the cross-section.
template <int N>
using Receptance = Eigen::Matrix<std::complex<double>, N, N>;

/// Stands in for a size of 0 that is divided by.
inline constexpr double kAboveZero = 1e-300;

/// The coordinates of a Receptance<4>, by their names in documents.
inline constexpr std::array<const char*, 4> kCoordinates = {"x", "slope_x", "y", "slope_y"};

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

/// A free part in one direction: movement of its end i per load at its end j (1: tip, 2: joint).
struct BeamReceptances {
  Receptance<2> r11, r12, r21, r22;
};

/// A round part has the same receptance in x and in y and does not couple them: the 2 x 2 block itself, or
/// twice on the diagonal of a 4 x 4 matrix.
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

/// Shear coefficient of a round bar or tube [Cowper1966].
double cowper_shear_coefficient(double inner_over_outer_diameter, double poisson_ratio);

/// How a segment moves at one angular frequency above 0 (rad/s). Relative error about 1e-13, from frequencies
/// at which it moves as a rigid body to those at which it carries many waves. Throws InvalidArgument for
/// sizes or frequencies that are not above 0.
class SegmentMotion {
 public:
  SegmentMotion(const BeamSegment& segment, BeamTheory theory, double omega_rad_per_s);

  /// Free at both ends.
  BeamReceptances free() const;

  /// The receptance at end 1 when end 2 is held by a part of receptance `holder` (zero: fixed); N is 2 or 4.
  /// A segment that is short compared with its waves is carried by its transfer matrix: the receptance of the
  /// free rigid body, which grows as 1 / w^2, never enters and so need not cancel (README.md, section 4).
  template <int N>
  Receptance<N> held(const Receptance<N>& holder) const;

  /// The one free part that the segment and `inner` make when the segment's end 2 is joined rigidly to end 1
  /// of `inner`; by its transfer matrix too where it is short, however short.
  BeamReceptances before(const BeamReceptances& inner) const;

 private:
  // Transfer matrix in four blocks: movement (deflection, slope) and load (force, moment) at end 1 from
  // movement and load at end 2.
  struct Transfer {
    Receptance<2> movement_of_movement, movement_of_load, load_of_movement, load_of_load;
  };
  bool short_;  // compared with its waves; then only transfer_ is set, else only free_
  Transfer transfer_;
  BeamReceptances free_;
};

}  // namespace stablecut::receptance
