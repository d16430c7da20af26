// The cutter, where its teeth are in cut, and the directional coefficients (thesis 6.2, eq. 6-3 to 6-8).
//
// A tooth's angle phi is measured clockwise from the cut frame's +Y axis. "Phase" is the angle of tooth 1;
// all quantities are periodic in it with the pitch 2 pi / N, so phases are taken from one pitch.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace stablecut {

/// A cutter with equally spaced straight teeth.
struct Cutter {
  int teeth = 0;              ///< N, at least 1
  double kt_n_per_m2 = 0;     ///< tangential cutting force coefficient
  double kr_n_per_m2 = 0;     ///< radial cutting force coefficient
  double entry_rad = 0;       ///< phi_st, 0 <= entry < exit
  double exit_rad = 0;        ///< phi_ex, at most pi
  double feed_angle_rad = 0;  ///< of the feed (the cut frame's X), from the structure's +x towards +y

  double pitch_rad() const;
  /// T = 60 / (N Omega), s.
  double tooth_period_s(double revolutions_per_s) const;
};

/// Entry and exit angles of a cut of radial immersion ae/D in (0, 1]: up from 0 to acos(1 - 2 ae/D), down
/// from acos(2 ae/D - 1) to pi.
void set_immersion(Cutter& cutter, bool up_milling, double radial_immersion);

/// A stretch of phases over which the same teeth are in cut, those at phase + j pitch, first <= j < last.
struct EngagedArc {
  double from_rad = 0;
  double to_rad = 0;  ///< may exceed the pitch: the arc is not split where the period is counted from
  int first_tooth = 0;
  int last_tooth = 0;
};

/// The engaged arcs of one pitch, in order, each of constant teeth in cut. The directional coefficients are
/// smooth inside each. Not empty.
std::vector<EngagedArc> engaged_arcs(const Cutter& cutter);

/// A of (6-8) in the structure's frame, Q A Q^T, N/m2, at a phase inside the arc (or at its ends: the limit
/// from inside).
Eigen::Matrix2d directional_coefficients(const Cutter& cutter, const EngagedArc& arc, double phase_rad);

/// A = drive * sense at a phase of the arc, in the structure's frame: the force is depth * drive * (sense *
/// (r - r_delayed)). One tooth in cut feels the chip thickness only, so its `sense` is one row; several need
/// both directions.
struct DirectionalFactors {
  Eigen::Matrix2Xd drive;                          ///< [2 x 1 or 2] N/m2
  Eigen::Matrix<double, Eigen::Dynamic, 2> sense;  ///< [1 or 2 x 2]
};
DirectionalFactors directional_factors(const Cutter& cutter, const EngagedArc& arc, double phase_rad);

/// The exact mean of A over the phases [from, to], as (6-29) asks; teeth may enter or leave inside.
Eigen::Matrix2d mean_directional_coefficients(const Cutter& cutter, double from_rad, double to_rad);

}  // namespace stablecut
