// The period map by collocation of the cutting force. README.md, "Collocation" and "The map of a period".
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "milling/collocation.h"
#include "milling/cut_schedule.h"
#include "milling/floquet.h"

namespace stablecut::milling {

/// With straight teeth the responses are those of the speed and the depth enters by a linear solve; with
/// helical ones they are computed for each depth.
class SpectralMap : public PeriodMap {
 public:
  /// `points` on the longest piece of the cut. The structure must outlive the map.
  SpectralMap(const TipStructure& structure, const Cutter& cutter, double revolutions_per_s, int points);
  /// From a schedule that is the same at every depth.
  SpectralMap(const TipStructure& structure, const CutSchedule& schedule, double revolutions_per_s,
              int points);

  /// [2 modes + remembered displacements, square]: of equal pitch one for each node, or two where both
  /// directions are sensed.
  Eigen::MatrixXd monodromy(double depth_m) const override;
  std::vector<ForceImpulse> forces(double depth_m, std::complex<double> multiplier,
                                   const Eigen::VectorXcd& state) const override;

 private:
  SpectralMap(const TipStructure& structure, const Cutter& cutter, const CutSchedule& at_no_depth,
              double revolutions_per_s, int points);
  Collocation at_depth(double depth_m) const;

  Cutter cutter_;
  double revolutions_per_s_;
  int points_;
  std::optional<Collocation> fixed_;  // none with helical teeth
};

/// The forces over a period, from what is sensed at the nodes.
std::vector<ForceImpulse> forces_of(const std::vector<CollocationNode>& nodes,
                                    const Eigen::VectorXcd& numbers);

}  // namespace stablecut::milling
