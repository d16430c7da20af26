// Where the teeth are in cut, piece by piece of a period, and the directional coefficients there, from
// [RobotMillingThesis, 6.2, eqs. 6-2 to 6-8]. README.md, "Force and chip thickness" and "Pieces of a period".
//
// The "turn" is the angle that the cutter has turned since the period's start; the period is the pitch where
// all pitches are equal, and with unequal pitches the revolution, or the part of it after which their pattern
// repeats.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <vector>

#include "milling/cutter.h"

namespace stablecut::milling {

/// A matrix of coefficients as the product drive * sense, in the structure's frame with z from the tip to the
/// spindle: the force per depth is drive * (sense * r), r a displacement or a velocity. The force of one
/// straight tooth depends on the chip thickness only, so that its `sense` has one row; that of several, or of
/// helical ones or such with a corner, on all directions: then it is the identity.
struct DirectionalFactors {
  Eigen::Matrix3Xd drive;                          ///< [3 x 1 or 3] N/m2, or N s/m2
  Eigen::Matrix<double, Eigen::Dynamic, 3> sense;  ///< [1 or 3 x 3]
};

/// A part of the period over which the coefficients are smooth.
struct CutPiece {
  double from_rad = 0, to_rad = 0;  ///< turn
  /// [RobotMillingThesis, eq. 6-8] at a turn, N/m2: of the displacement less the one that the surface keeps.
  std::function<DirectionalFactors(double turn_rad)> cutting;
  /// The same of the velocity, N s/m2; empty without process damping.
  std::function<DirectionalFactors(double turn_rad)> damping;
  std::size_t cut_by = 0;        ///< index of the piece that cut this one's surface, of the same length
  bool in_period_before = true;  ///< whether it did so in the period before this one
};

struct CutSchedule {
  double period_rad = 0;
  int passes = 1;  ///< teeth that pass in a period
  std::vector<CutPiece> pieces;
};

/// The pieces of a period at a speed (on which process damping depends) and a depth (over which helical edges
/// lag). With equal pitches pieces end where any part of a tooth enters or leaves, and the force on one is
/// that of all teeth in cut; turns count from the first such place. With unequal ones each tooth has pieces
/// of its own, which end also where another tooth enters or leaves while this one, or the one before it,
/// cuts.
/// Where helices differ, the edges are straight discs instead, which cut each for itself: as many of them
/// that a disc's lag is some of the `points` on its way through the cut.
CutSchedule cut_schedule(const Cutter& cutter, double revolutions_per_s, double depth_m, int points = 1);

/// With unequal pitches the way of each tooth through the cut in one piece, whether or not others enter and
/// leave meanwhile, from where it enters in the period; it may end in the next one. Straight teeth. In the
/// order of the teeth, which is that of the beginnings: the first one's surface was cut in the period before.
CutSchedule tooth_arcs(const Cutter& cutter, double revolutions_per_s);

/// The way of one tooth through the cut at a speed and a depth: parts over which its coefficients are smooth,
/// between angles of its tip.
std::vector<CutPiece> way_of_tooth(const Cutter& cutter, double revolutions_per_s, double depth_m);

/// Where helical teeth of equal pitch are in cut at any depth up to the largest: the tip angle from which on,
/// and how far, at most a pitch.
struct HelicalArc {
  double from_rad = 0, length_rad = 0;
};
HelicalArc helical_arc(const Cutter& cutter, double largest_depth_m);
/// The pieces of one pitch at a depth, turns counted from a tip angle, whether or not a piece begins there.
CutSchedule helical_pieces(const Cutter& cutter, double depth_m, double from_rad);

/// The exact mean of A while tooth 1 turns through the angles [from, to], for straight teeth of equal pitch
/// at a depth [RobotMillingThesis, eq. 6-29]. Teeth may enter or leave in between. N/m2.
Eigen::Matrix3d mean_directional_coefficients(const Cutter& cutter, double from_rad, double to_rad,
                                              double depth_m);

}  // namespace stablecut::milling
