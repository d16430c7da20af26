// The cutter, where its teeth are in cut, and the directional coefficients (thesis 6.2, eq. 6-3 to 6-8).
//
// A tooth's angle phi is measured clockwise from the cut frame's +Y axis, at the tip. "Turn" is how far the
// cutter has turned since the period's start; the period is the pitch where all pitches are equal, and the
// revolution otherwise.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <vector>

namespace stablecut::milling {

struct Cutter {
  int teeth = 0;                  ///< N, at least 1
  double kt_n_per_m2 = 0;         ///< tangential cutting force coefficient
  double kr_n_per_m2 = 0;         ///< radial cutting force coefficient
  double entry_rad = 0;           ///< phi_st, 0 <= entry < exit
  double exit_rad = 0;            ///< phi_ex, at most pi
  double feed_angle_rad = 0;      ///< of the feed (the cut frame's X), from the structure's +x towards +y
  std::vector<double> pitch_rad;  ///< from each tooth to the next through the cut, sum 2 pi; empty: equal
  double lag_rad_per_m = 0;       ///< of a helical edge behind its tip: 2 tan(helix) / diameter
  double diameter_m = 0;          ///< wanted by process damping and by cut_rate
  /// Process damping: the flank ploughs with the force C / v times depth times speed of penetration against
  /// it, and with `damping_friction` times that along the cut (v: cutting speed).
  double damping_n_per_m = 0;
  double damping_friction = 0;

  bool equal_pitch() const { return pitch_rad.empty(); }
  double mean_pitch_rad() const;
  /// T = 60 / (N Omega), s: of the mean pitch.
  double tooth_period_s(double revolutions_per_s) const;
};

/// Entry and exit angles of a cut of radial immersion ae/D in (0, 1]: up from 0 to acos(1 - 2 ae/D), down
/// from acos(2 ae/D - 1) to pi.
void set_immersion(Cutter& cutter, bool up_milling, double radial_immersion);

/// A coefficient matrix as drive * sense, in the structure's frame: the force per depth is drive * (sense *
/// r) with r a displacement (or a velocity). One straight tooth in cut feels the chip thickness only, so its
/// `sense` is one row; else both directions are felt.
struct DirectionalFactors {
  Eigen::Matrix2Xd drive;                          ///< [2 x 1 or 2] N/m2, or N s/m2
  Eigen::Matrix<double, Eigen::Dynamic, 2> sense;  ///< [1 or 2 x 2]
};

/// A stretch of the period over which the coefficients are smooth.
struct CutPiece {
  double from_rad = 0, to_rad = 0;  ///< turn
  /// (6-8) at a turn, of the displacement less what was left by the tooth before, N/m2.
  std::function<DirectionalFactors(double turn_rad)> cutting;
  /// The same of the velocity, N s/m2; empty without process damping.
  std::function<DirectionalFactors(double turn_rad)> damping;
  std::size_t left_by = 0;  ///< the piece that cut the surface before: as long, felt alike
  bool left_before = true;  ///< and did so in the period before
};

struct CutSchedule {
  double period_rad = 0;
  int passes = 1;  ///< teeth that pass in a period
  std::vector<CutPiece> pieces;
};

/// All that cuts in a period at a depth (which helical edges lag over) and a speed (which damping knows).
/// With equal pitches the pieces end where any part of a tooth enters or leaves, and hold all teeth in cut;
/// turns are counted from the first such place. With unequal ones each tooth has its own, ending also where
/// another tooth enters or leaves while it or the tooth before it cuts.
CutSchedule cut_schedule(const Cutter& cutter, double revolutions_per_s, double depth_m);

/// The exact mean of A over the phases [from, to] of straight teeth of equal pitch, as (6-29) asks; a phase
/// is the angle of tooth 1. Teeth may enter or leave inside. N/m2.
Eigen::Matrix2d mean_directional_coefficients(const Cutter& cutter, double from_rad, double to_rad);

}  // namespace stablecut::milling
