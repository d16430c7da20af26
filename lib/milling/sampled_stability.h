// The uncertainty of a chart: the same cut with modal tables and cutting coefficients drawn at random.
// README.md, "Sampled stability".
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

/// Standard deviations of the cutting coefficients, N/m2, and how they go together.
struct CoefficientDeviations {
  double kt_n_per_m2 = 0, kr_n_per_m2 = 0;
  double correlation = 0;
};

struct SampledCut {
  TipStructure structure;
  Cutter cutter;
};

/// Cuts whose modal parameters are drawn from a normal distribution with the model's covariance (where it has
/// none, they are as in the model), and whose coefficients are drawn with their deviations; in pairs on
/// opposite sides of the mean [Hammersley1956]. Frequencies, damping ratios and Kt are kept above a hundredth
/// of their mean, Kr above 0. The same cuts for the same seed.
std::vector<SampledCut> sampled_cuts(const dynamics::ModalModel& model, const Cutter& cutter,
                                     const CoefficientDeviations& deviations, int count, unsigned seed);

/// Moves the cutter's Kt and Kr, within those bounds.
void set_coefficients(Cutter& cutter, double kt_by_n_per_m2, double kr_by_n_per_m2);

struct SampledStability {
  Eigen::MatrixXd stable_share;  ///< [depths x speeds] of the samples; empty if unasked
  /// [speeds] 2.5 % and 97.5 % quantiles of the limit depth, m; none: above the largest depth.
  std::vector<std::array<std::optional<double>, 2>> limit_95_m;
};

/// The share of the samples that is stable, and quantiles of their limits. `points` [speeds]: points on the
/// longest piece of the cut, as many as the mean cut needed.
SampledStability sampled_stability(const std::vector<SampledCut>& samples,
                                   const std::vector<double>& revolutions_per_s,
                                   const std::vector<double>& depths_m, const std::vector<int>& points,
                                   bool with_grid, int threads, const Progress& progress = {});

}  // namespace stablecut::milling
