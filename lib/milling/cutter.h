// The cutter and what it cuts [RobotMillingThesis, 6.2]. README.md, "Force and chip thickness".
//
// A tooth's angle phi is measured clockwise from the cut frame's +Y axis, at the tip.
#pragma once

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
  /// [teeth] the same of each tooth where helices differ: pitch_rad, which is never empty then, is that of
  /// the tips.
  std::vector<double> tooth_lag_rad_per_m;
  double diameter_m = 0;  ///< needed by process damping and cut_rate only
  /// Process damping [Tyler2013]: the flank's force against penetration is C / v times the depth times the
  /// speed of penetration (v: cutting speed), and along the cut `damping_friction` times that.
  double damping_n_per_m = 0;  ///< C
  double damping_friction = 0;

  /// Lead angle of the edge: from the plane normal to the axis; and the radius of the corner at its tip.
  double lead_rad = kPi / 2;
  double corner_radius_m = 0;

  bool equal_pitch() const { return pitch_rad.empty(); }
  bool helices_differ() const { return !tooth_lag_rad_per_m.empty(); }
  double lag_of(int tooth) const { return helices_differ() ? tooth_lag_rad_per_m[tooth] : lag_rad_per_m; }
  /// The largest size of them.
  double largest_lag_rad_per_m() const;
  /// Where helices differ: the height at which an edge comes up with the one before it; else infinite.
  double edges_meet_at_m() const;
  /// Throws NoAnswer where they meet below a depth, or at it.
  void check_edges_apart(double depth_m) const;
  /// Where helices differ: straight teeth with the pitches of a height below that one. Its first tooth is the
  /// cutter's at an angle lag_of(0) * height_m behind.
  Cutter at_height(double height_m) const;
  /// Whether the edge is parallel to the axis (or winds round it), all of it.
  bool is_upright() const { return lead_rad == kPi / 2 && corner_radius_m == 0; }
  /// Whether a motion along the axis, or a force along it, takes part.
  bool is_axial() const { return ka_n_per_m2 != 0 || !is_upright(); }
  /// Whether coefficients per depth depend on the depth.
  bool changes_with_depth() const { return lag_rad_per_m != 0 || helices_differ() || corner_radius_m > 0; }
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

}  // namespace stablecut::milling
