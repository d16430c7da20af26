// Where the search for the modes of one group of directions stands: a value that each of its steps takes and
// gives.
#pragma once

#include <vector>

#include "modal/fit_data.h"
#include "modal/maximum_likelihood.h"
#include "modal/noise_weights.h"

namespace stablecut::modal {

/// The modes of one independent group of directions, and everything that they are judged by.
struct GroupFit {
  FitData data;                  ///< the curves, with weights from `variance` and `regime`
  CurveVariances variance;       ///< of the noise
  CurveVariances shared;         ///< variance of what curves of one reference share; empty: nothing
  bool noise_estimated = false;  ///< `variance` was estimated, not given
  Regime regime = Regime::kNoise;
  ModeModel model = ModeModel::kNonsymmetric;
  RefinedModes refined;           ///< the modes, with their chi-square
  Eigen::VectorXcd start_poles;   ///< of the curves, each with residues of its own
  bool selection_settled = true;  ///< no mode was left to be added or removed when the selection ended

  const std::vector<dynamics::Mode>& modes() const { return refined.modes; }
  /// Modes that are no residual terms.
  std::size_t own_modes() const;
  /// The given modes refined with these weights, in this model.
  RefinedModes refine(const std::vector<dynamics::Mode>& modes, const Effort& effort) const;
  /// Weighs the curves anew, in that regime.
  void weigh(Regime regime_now);

  /// Number of complex values fitted.
  double complex_values() const { return data.values() / 2; }
  /// Free real parameters of one mode, of those that some curve shows.
  double parameters_per_mode() const;
  /// Complex values less the (half) parameters of all modes, at least 1.
  double degrees_of_freedom() const;
  /// chi-square over the degrees of freedom: 1 when only noise of the expected size is left.
  double reduced_chi_square() const { return refined.chi_square / degrees_of_freedom(); }

  /// How many times less the residual tells than its length: 1 where it is white noise of the expected size,
  /// more where it is larger or, limited by a model error, smooth over lines. Variances of parameters grow by
  /// it.
  double inflation() const;
  /// The same of other modes: mean chi-square (if above 1) times the correlation length of the residual.
  double inflation_of(const RefinedModes& others) const;

  /// What modes are expected to leave of the curves where the model is the limit, as `relative_error` has it:
  /// kModelErrorFloor and the noise, but no more than a table is to leave.
  double expected_error() const;

  /// The residual is clearly larger than the noise; the same of another chi-square.
  bool exceeds_noise() const { return exceeds_noise(refined.chi_square); }
  bool exceeds_noise(double chi_square) const;
  /// The residual can be white noise, as far as so many lines can tell.
  bool residual_is_white() const;
  /// More modes stand at one pole than there are directions: they imitate something else.
  bool is_crowded() const;
  /// Whether modes in the band have no resonance: they only help others to a shape that is none of a mode.
  bool has_helpers() const;
};

/// |model - h| / |h|, root mean square over the curves that are not zero.
double relative_error(const FitData& data, const std::vector<dynamics::Mode>& modes);

/// chi-square over the degrees of freedom, of several groups together.
double reduced_chi_square_of(const std::vector<GroupFit>& fits);

}  // namespace stablecut::modal
