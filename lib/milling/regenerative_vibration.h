// The periodic motion of the tip where it changes the chip. README.md, "Vibration that changes the chip".
#pragma once

#include <Eigen/Core>
#include <vector>

#include "milling/cutting_force.h"
#include "milling/forced_vibration.h"

namespace stablecut::milling {

/// The tip's motion at one speed with unequal pitches or runout, where teeth leave different surfaces, or
/// with process damping: the periodic solution of the delay equation, by collocation. It is linear: each
/// tooth cuts where it would cut if the tip stood still.
class RegenerativeVibration {
 public:
  /// At these turns. Helical edges lag, and corners are, as at `depth_m`. A radian of cut has
  /// `points_per_rad` collocation points at least; `forced` is the motion under the mean chip, of the same
  /// arguments.
  RegenerativeVibration(const TipStructure& structure, const Cutter& cutter, const CuttingLoad& load,
                        const ForcedVibration& forced, double revolutions_per_s, double depth_m,
                        double points_per_rad, const std::vector<double>& turns_rad);

  /// [3 x turns] m, in the cut's frame: at any depth where the cutter does not change with it, else at the
  /// one given before.
  Eigen::Matrix3Xd displacements(double depth_m) const;

 private:
  // What the force of the chip depends on, d, and the displacements r at the turns, per depth and of unit
  // depth: d = depth (sensed_forced_ + sensed_ d), r = depth (moved_forced_ + moved_ d).
  Eigen::MatrixXd sensed_, moved_;
  Eigen::VectorXd sensed_forced_, moved_forced_;
};

}  // namespace stablecut::milling
