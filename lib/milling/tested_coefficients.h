// Kt and Kr from cuts that were tried on the machine. README.md, "Coefficients from tested cuts".
#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <vector>

#include "base/progress.h"
#include "dynamics/modal_model.h"
#include "milling/sampled_stability.h"
#include "milling/tested_cuts.h"

namespace stablecut::milling {

/// [cuts x samples] whether a sample is stable in a cut.
using Verdicts = Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic>;

/// By the limits at each cut's speed, with as many points as the mean cut takes there. Throws NoAnswer where
/// a speed cannot be resolved.
Verdicts verdicts_of(const std::vector<SampledCut>& samples, const SampledCut& mean,
                     const std::vector<TestedCut>& cuts, int threads, const Progress& progress = {});

struct PosteriorRequest {
  double wrong_share = 0.05;  ///< of the observations, each by itself, in (0, 1/2)
  int samples = 2000;         ///< at least two
  unsigned seed = 1;
};

/// What is known of Kt and Kr (N/m2) after the cuts.
struct CoefficientPosterior {
  double kt_n_per_m2 = 0, kr_n_per_m2 = 0;  ///< means
  CoefficientDeviations deviations;
  std::array<double, 2> kt_95_n_per_m2{}, kr_95_n_per_m2{};  ///< 2.5 % and 97.5 % quantiles
  /// As many equally likely samples would say it as surely [Kish1965].
  double effective_samples = 0;
  double contradicting = 0;     ///< observations that are not the model's verdict: posterior mean
  int least_contradicting = 0;  ///< of the sample that agrees best
  /// Of sets of observations drawn from the prior, with as many wrong ones as stated, the share that is no
  /// likelier than these, or that contradicts the samples as much: a p value of both. Near 0 the cuts
  /// contradict the prior, or more of them are wrong.
  double as_unlikely_share = 0;
  Eigen::VectorXd stable_share;  ///< [cuts] posterior probability that the model is stable
};

/// The prior: Kt and Kr of `cutter` with normal deviations, bounded as those of sampled_cuts(), and the
/// model's own covariance. `verdicts` says of samples whether they are stable in the cuts that were observed.
CoefficientPosterior coefficient_posterior(
    const dynamics::ModalModel& model, const Cutter& cutter, const CoefficientDeviations& prior,
    const std::vector<bool>& observed_stable,
    const std::function<Verdicts(const std::vector<SampledCut>&)>& verdicts, const PosteriorRequest& request);

}  // namespace stablecut::milling
