// The force on the tool of a cut at a depth, that of the mean chip: its mean, its way over a period, and what
// it is while teeth leave the walls. README.md, "The force of a cut".
#pragma once

#include <Eigen/Core>
#include <vector>

#include "milling/cutter.h"
#include "milling/cutting_force.h"

namespace stablecut::milling {

/// In the cut's frame, N, columns [feed, normal, axial]: X along the feed, Y to its left seen from the
/// spindle, Z from the tip to the spindle.
struct TurningForce {
  Eigen::Vector3d mean_n;
  /// At turns at most a degree apart, both sides of each jump among them, in the order of a period.
  Eigen::Matrix3Xd turning_n;

  /// A wall that the cut leaves, by the angle at which a tooth touches it: 0 on the side of +Y, pi on that of
  /// -Y.
  struct Wall {
    double angle_rad;
    /// While places along a tooth's edge, from the tip up, touch the wall: the tooth itself is in cut. Of an
    /// edge that lags by more than a period, a period's. None
    /// where teeth differ, as the one that cuts deepest leaves the wall then.
    Eigen::Matrix3Xd leaving_n;
  };
  std::vector<Wall> walls;
};

/// `depth_m` above 0.
TurningForce turning_force(const Cutter& cutter, const CuttingLoad& load, double depth_m);

}  // namespace stablecut::milling
