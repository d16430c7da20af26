// Stability charts: spectral radii over speeds and depths, and the limit depth at each speed.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

#include "base/progress.h"
#include "milling/cutter.h"
#include "milling/floquet.h"
#include "milling/limits.h"

namespace stablecut::milling {

/// Radii are NaN where their error leaves open whether they are above 1, also at speeds whose limits are
/// known. Where a speed cannot be resolved its `failure` says why, and nothing is known there: radii are NaN,
/// there are no crossings, and the resolution is 0.
struct StabilityChart {
  Eigen::MatrixXd spectral_radius;  ///< [depths x speeds], of one tooth period; empty without a grid
  std::vector<std::vector<StabilityCrossing>> crossings;  ///< [speeds], by depth: all of them
  std::vector<double> error;                              ///< [speeds] estimated, of the spectral radius
  std::vector<int> resolution;       ///< [speeds] points on the longest piece of the cut, or intervals
  std::vector<std::string> failure;  ///< [speeds] empty where there is an answer

  /// The number of radii that are not known at speeds that have an answer.
  std::size_t doubtful() const;
};

/// Radii at all speeds and depths, and all crossings between depth 0 and the largest. `depths_m` increasing,
/// at least one. Without `with_grid` only the crossings are computed. Throws NoAnswer where no
/// speed can be resolved.
StabilityChart stability_chart(const TipStructure& structure, const Cutter& cutter,
                               const std::vector<double>& revolutions_per_s,
                               const std::vector<double>& depths_m, const StabilityScheme& scheme,
                               bool with_grid, int threads, const Progress& progress = {});

}  // namespace stablecut::milling
