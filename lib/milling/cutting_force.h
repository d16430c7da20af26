// The force of a cut that does not vibrate, from its mean chip. README.md, "The force of a cut".
#pragma once

#include <Eigen/Core>
#include <vector>

#include "milling/cutter.h"
#include "milling/turning_arcs.h"

namespace stablecut::milling {

/// What the force of a chip needs beside the cutter: what stability does not depend on.
struct CuttingLoad {
  double feed_per_tooth_m = 0;  ///< mean over the teeth
  double kte_n_per_m = 0;       ///< edge forces along the cut, across it and along the axis
  double kre_n_per_m = 0;
  double kae_n_per_m = 0;
  /// [teeth] radius of each tooth above the mean; empty: none.
  std::vector<double> runout_m;
};

/// Components of a force: feed, normal and axial (the cut's frame: X, Y, and Z from the tip to the spindle),
/// and the sum of what the teeth feel along the cut, which times the radius is the torque.
using ForceParts = Eigen::Vector4d;

/// The force of straight teeth per depth, N/m: the sum over the arcs on which a tooth's chip thickness is one
/// multiple of sin(phi) and a constant, repeated every period.
struct ForceCycle {
  double period_rad = 0;  ///< the pitch, or the revolution where teeth differ
  std::vector<TurningArc<4>> arcs;

  ForceParts mean() const { return integral_to(arcs, period_rad, period_rad) / period_rad; }
};

/// Whether every tooth cuts as the one before it does, but for vibration.
bool cuts_alike(const Cutter& cutter, const CuttingLoad& load);
/// After which the force of the mean chip repeats: the pitch, or the revolution where teeth differ.
double force_period_rad(const Cutter& cutter, const CuttingLoad& load);

/// A part of a tooth's way through the cut on which one tooth before it has left the surface: its mean chip
/// thickness there is slope * sin(phi) + offset.
struct Bite {
  int tooth = 0;          ///< index
  double behind_rad = 0;  ///< of the first tooth: phi is the turn less this
  double delay_rad = 0;   ///< the turn since the surface was left
  double slope_m = 0, offset_m = 0;
  double entry_rad = 0, exit_rad = 0;  ///< phi
};
/// Of one tooth where all are alike, which is repeated every pitch, else of all in a revolution. The chip of
/// a tooth is what the teeth before it left: with runout that may be the work of a tooth further back, and a
/// tooth may cut nothing.
std::vector<Bite> bites(const Cutter& cutter, const CuttingLoad& load);

/// Turn 0: tooth 1 at phi = 0. At a depth, on which the force per depth depends where the edge has a corner.
ForceCycle force_cycle(const Cutter& cutter, const CuttingLoad& load, double depth_m);

}  // namespace stablecut::milling
