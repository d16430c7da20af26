// Converged stability by collocation of the cutting force on the pieces of the period where it is smooth.
//
// On each piece the force is a polynomial through its values at Gauss points; the structure's response to
// that polynomial, and its free flight between pieces, are exact. The spectral radius converges exponentially
// with the number of points (with unequal pitches and several teeth in cut algebraically: kinks of high order
// travel from tooth to tooth). With straight teeth the response matrices depend on the speed only and the
// depth enters through a small linear solve; with helical ones they are computed for each depth.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "milling/cutter.h"
#include "milling/floquet.h"

namespace stablecut::milling {

/// Responses at unit depth of what the nodes sense and of the state at the period's end. A row is what is
/// sensed at a node: a displacement, less what was left by the tooth before, or a velocity (process damping).
struct Collocation {
  struct Node {
    double time_s, weight_s;  ///< quadrature weight over the period
    Eigen::Index first_row;
    Eigen::MatrixXd drive;  ///< [directions x rows of the node], N/m2 or N s/m2
  };
  std::vector<Node> nodes;
  /// Of each row, the row that sensed the surface before, -1 for a velocity; and the entry of the state that
  /// holds what it sensed in the period before, -1 where it is of this period.
  std::vector<Eigen::Index> left_by, stored;
  Eigen::Index stored_count = 0;
  Eigen::MatrixXd difference_of_state;  ///< [rows x 2 modes]
  Eigen::MatrixXd difference_of_drive;  ///< [rows x rows]
  Eigen::MatrixXd final_of_state, final_of_drive;
};

/// `points` >= 1 on the longest piece, fewer on shorter ones. Throws InvalidArgument where a piece and the
/// one that left its surface are not of one length.
Collocation collocate(const TipStructure& structure, const CutSchedule& schedule, double revolutions_per_s,
                      int points);

class SpectralMap : public PeriodMap {
 public:
  /// The structure must outlive the map.
  SpectralMap(const TipStructure& structure, const Cutter& cutter, double revolutions_per_s, int points);
  /// Of a schedule that holds at any depth.
  SpectralMap(const TipStructure& structure, const CutSchedule& schedule, double revolutions_per_s,
              int points);

  /// [2 modes + what is remembered, square]: one number for each node (two where both directions are felt) of
  /// the last pass.
  Eigen::MatrixXd monodromy(double depth_m) const override;
  std::vector<ForceImpulse> forces(double depth_m, std::complex<double> multiplier,
                                   const Eigen::VectorXcd& state) const override;

 private:
  Collocation of_helix(double depth_m) const;

  Cutter cutter_;
  double revolutions_per_s_;
  int points_;
  std::optional<Collocation> fixed_;  // with straight teeth
};

}  // namespace stablecut::milling
