// The periodic motion of the tip under the force of a cut. README.md, "Forced vibration".
#pragma once

#include <Eigen/Core>
#include <vector>

#include "milling/cutting_force.h"
#include "milling/structure.h"

namespace stablecut::milling {

/// The structure's modes as the cut sees them: q' = rate q + drive^T f per radian of turn, r = 2 Re(shape q),
/// with the force and the displacement r along the feed, normal to it and along the axis.
struct ModesInCut {
  Eigen::VectorXcd rate;    ///< [modes], per rad
  Eigen::Matrix3Xcd shape;  ///< [3 x modes], sqrt(s/kg)
  Eigen::Matrix3Xcd drive;  ///< [3 x modes], sqrt(s/kg) s/rad
};
ModesInCut modes_in_cut(const TipStructure& structure, const Cutter& cutter, double revolutions_per_s);

/// The tip's motion at one speed where it does not change the chip: equal pitches without runout, where every
/// tooth leaves the same surface, and no process damping. Exact: each mode's motion between the breaks of the
/// force is known in closed form.
class ForcedVibration {
 public:
  /// `force` as force_cycle(), turned by the cutter's feed angle into the structure's frame.
  ForcedVibration(const TipStructure& structure, const Cutter& cutter, const ForceCycle& force,
                  double revolutions_per_s);

  double period_rad() const { return period_rad_; }
  /// Displacement at a turn, m, in the cut's frame: along the feed, normal to it and along the axis.
  Eigen::Vector3d displacement(double depth_m, double turn_rad) const;
  /// Its rate of change per turn, m/rad.
  Eigen::Vector3d slope(double depth_m, double turn_rad) const;
  /// The displacement at `count` turns at equal distances over a period from turn 0, [3 x count]: cheaper.
  Eigen::Matrix3Xd displacements(double depth_m, int count) const;
  /// Its mean over the period.
  Eigen::Vector3d mean(double depth_m) const { return depth_m * mean_; }

 private:
  // What the beginning or end of an arc adds to the modes' free motion.
  struct Break {
    double turn_rad;
    Eigen::VectorXcd jump;  // [modes]
  };
  // The modes' free motion at some turn: what all breaks before have left of it, and the sum of the jumps,
  // but for a constant.
  struct Free {
    Eigen::VectorXcd state, jumped;
  };
  Free free_at(double turn_rad) const;
  template <typename Visit>
  void walk(double from_rad, int count, const Visit& visit) const;
  Eigen::Matrix3Xd per_depth(double from_rad, int count) const;
  Eigen::Matrix3Xd integrals(double from_rad, int count) const;
  Eigen::Matrix3Xd over_depth(double depth_m, double from_rad, int count) const;

  double period_rad_, lag_rad_per_m_;
  Eigen::VectorXcd rate_;    // [modes], per rad of turn
  Eigen::Matrix3Xcd shape_;  // [3 x modes], in the cut's frame
  std::vector<Break> breaks_;
  std::vector<TurningArc<3>> driven_, driven_slope_;  // while an arc is in cut
  Eigen::Vector3d mean_;
};

}  // namespace stablecut::milling
