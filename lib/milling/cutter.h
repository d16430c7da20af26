// The cutter, where its teeth are in cut, and the directional coefficients, from [RobotMillingThesis, 6.2,
// eqs. 6-2 to 6-8]. README.md, "Force and chip thickness" and "Pieces of a period".
//
// A tooth's angle phi is measured clockwise from the cut frame's +Y axis, at the tip. The "turn" is the angle
// that the cutter has turned since the period's start; the period is the pitch where all pitches are equal,
// and with unequal pitches the revolution, or the part of it after which their
// pattern repeats.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <vector>

#include "base/units.h"

namespace stablecut::milling {

struct Cutter {
  int teeth = 0;              ///< N, at least 1
  double kt_n_per_m2 = 0;     ///< tangential cutting force coefficient
  double kr_n_per_m2 = 0;     ///< radial cutting force coefficient
  double ka_n_per_m2 = 0;     ///< axial cutting force coefficient, from the tip to the spindle
  double entry_rad = 0;       ///< phi_st, 0 <= entry < exit
  double exit_rad = 0;        ///< phi_ex, at most pi
  double feed_angle_rad = 0;  ///< of the feed (the cut frame's X), from the structure's +x towards +y
  /// From each tooth to the next one through the cut, sum 2 pi; empty: equal [Altintas1999].
  std::vector<double> pitch_rad;
  /// How far a helical edge lags behind its tip: 2 tan(helix) / diameter [Zatarain2006].
  double lag_rad_per_m = 0;
  double diameter_m = 0;  ///< needed by process damping and cut_rate only
  /// Process damping [Tyler2013]: the flank's force against penetration is C / v times the depth times the
  /// speed of penetration (v: cutting speed), and along the cut `damping_friction` times that.
  double damping_n_per_m = 0;  ///< C
  double damping_friction = 0;

  /// Lead angle of the edge: from the plane normal to the axis; and the radius of the corner at its tip.
  double lead_rad = kPi / 2;
  double corner_radius_m = 0;

  bool equal_pitch() const { return pitch_rad.empty(); }
  /// Whether the edge is parallel to the axis (or winds round it), all of it.
  bool is_upright() const { return lead_rad == kPi / 2 && corner_radius_m == 0; }
  /// Whether a motion along the axis, or a force along it, takes part.
  bool is_axial() const { return ka_n_per_m2 != 0 || !is_upright(); }
  /// Whether coefficients per depth depend on the depth.
  bool changes_with_depth() const { return lag_rad_per_m != 0 || corner_radius_m > 0; }
  double mean_pitch_rad() const;
  /// From a tooth (index) to the one that follows it through the cut.
  double pitch_after(int tooth) const { return equal_pitch() ? mean_pitch_rad() : pitch_rad[tooth]; }
  /// T = 60 / (N Omega), s: of the mean pitch.
  double tooth_period_s(double revolutions_per_s) const;
};

/// Entry and exit angles of a cut of radial immersion ae/D in (0, 1]: up from 0 to acos(1 - 2 ae/D), down
/// from acos(2 ae/D - 1) to pi.
void set_immersion(Cutter& cutter, bool up_milling, double radial_immersion);

/// An angle this near to that of a wall is at it, rad.
inline constexpr double kAtWall = 1e-9;
/// The walls that a cut leaves, by the angle at which a tooth touches one: 0 on the side of the cut frame's
/// +Y where teeth enter there (up milling), pi on that of -Y where they leave there (down milling).
std::vector<double> wall_angles(const Cutter& cutter);

/// Means over the depth of cut of functions of the angle kappa between the edge and the plane normal to the
/// axis: 90 degrees for an end mill.
struct EdgeMeans {
  double sine = 1, cosine = 0, cotangent = 0, cosine_cotangent = 0, inverse_sine = 1;
};
EdgeMeans edge_means(const Cutter& cutter, double depth_m);

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
CutSchedule cut_schedule(const Cutter& cutter, double revolutions_per_s, double depth_m);

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
