// How sure a chart is: the cut again with tables and coefficients as they may be.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "base/progress.h"
#include "dynamics/modal_model.h"
#include "milling/cutter.h"
#include "milling/structure.h"

namespace stablecut::milling {

/// Standard deviations of the cutting coefficients, N/m2.
struct CoefficientDeviations {
  double kt_n_per_m2 = 0, kr_n_per_m2 = 0;
};

struct SampledCut {
  TipStructure structure;
  Cutter cutter;
};

/// Cuts with normally distributed parameters of the model, as its covariance says (none: exact), and
/// coefficients; in pairs on opposite sides of the mean. Damping and Kt are kept from falling below a
/// hundredth of their mean, Kr below 0. The same numbers for the same seed.
std::vector<SampledCut> sampled_cuts(const dynamics::ModalModel& model, const Cutter& cutter,
                                     const CoefficientDeviations& deviations, int count, unsigned seed);

struct SampledStability {
  Eigen::MatrixXd stable_share;  ///< [depths x speeds] of the samples; empty if unasked
  /// [speeds] 2.5 % and 97.5 % quantiles of the limit depth, m; none: above the largest depth.
  std::vector<std::array<std::optional<double>, 2>> limit_95_m;
};

/// `points` on the longest arc at each speed: as many as the mean cut needs.
SampledStability sampled_stability(const std::vector<SampledCut>& samples,
                                   const std::vector<double>& revolutions_per_s,
                                   const std::vector<double>& depths_m, const std::vector<int>& points,
                                   bool with_grid, int threads, const Progress& progress = {});

}  // namespace stablecut::milling
