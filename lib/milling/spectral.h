// Converged stability by collocation of the cutting force on the engaged arcs.
//
// The force is a polynomial through its values at Gauss points on each engaged arc, where it is smooth; the
// structure's response to that polynomial, and its free flight between arcs, are exact. The spectral radius
// converges exponentially with the number of points. The response matrices depend on the speed only; the
// depth enters through a small linear solve.
#pragma once

#include <Eigen/Core>

#include "milling/cutter.h"
#include "milling/floquet.h"

namespace stablecut {

class SpectralMap : public PeriodMap {
 public:
  /// `points_per_arc` >= 1. The structure must outlive the map.
  SpectralMap(const TipStructure& structure, const Cutter& cutter, double revolutions_per_s,
              int points_per_arc);

  /// [2 modes + points (twice where several teeth cut and both directions move), square].
  Eigen::MatrixXd monodromy(double depth_m) const override;

 private:
  Eigen::MatrixXd sensed_of_state_;  // at the nodes, from the state at the period's start
  Eigen::MatrixXd sensed_of_drive_;  // at the nodes, from the nodes' u - u_delayed at unit depth
  Eigen::MatrixXd final_state_of_state_;
  Eigen::MatrixXd final_state_of_drive_;
};

}  // namespace stablecut
