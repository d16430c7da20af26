// From measured receptances to a table of modes, without any guess by the user.
//
// Vector fitting from start poles spread over the band finds candidate poles; statistics decide which of them
// are modes (a mode stays when taking it away costs more likelihood than its parameters are worth, a mode is
// added where the residual asks for one); all are refined together by maximum likelihood with rank-1
// residues.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/progress.h"
#include "dynamics/frequency_response.h"
#include "dynamics/modal_model.h"
#include "modal/fit_data.h"
#include "modal/mode_parameters.h"

namespace stablecut::modal {

struct FitOptions {
  std::optional<int> modes;  ///< how many, instead of finding out; shared evenly among independent groups
  /// Empty: the one of the three with the least information criterion.
  std::optional<ModeModel> model = ModeModel::kNonsymmetric;
  Progress progress;
};

/// One model's share in the choice: Schwarz' criterion chi_square / inflation + parameters log(values),
/// smaller is better.
struct ModelCriterion {
  ModeModel model = ModeModel::kNonsymmetric;
  std::size_t modes = 0;
  double parameters = 0;
  double chi_square = 0;  ///< sum over real and imaginary parts of squares over their variance
  double bic = 0;
};

/// How far the measurement is from reciprocal: sums over all pairs of directions measured both ways.
struct Reciprocity {
  double index = 0;  ///< |H_ij - H_ji| / (|H_ij| + |H_ji|), norms over the lines: 0 reciprocal, at most 1
  double noise = 0;  ///< what the noise alone would make of it
};

/// How well one measured curve is met.
struct CurveFit {
  std::string response, reference;
  double relative_error = 0;      ///< |model - h| / |h|, norms over the lines
  double reduced_chi_square = 0;  ///< mean |model - h|^2 / variance, 1 when noise is all that is left
};

struct ModalFit {
  dynamics::ModalModel model;  ///< modes by frequency; out of band marked; with its covariance
  ModeModel mode_model = ModeModel::kNonsymmetric;
  std::vector<ModelCriterion> criteria;  ///< of the models that were tried
  /// How many times less the residual tells than its length, 1 for white noise of the expected size: standard
  /// deviations are widened by its root. The largest of the groups.
  double inflation = 1;
  std::optional<Reciprocity> reciprocity;
  std::vector<FitData> data;  ///< the curves of each independent group, as they were weighted
  std::vector<CurveFit> curves;
  double relative_error = 0;      ///< over all curves together
  double reduced_chi_square = 0;  ///< mean over the values less the parameters
  bool variance_given = false;    ///< the noise came with the measurement; otherwise it was estimated from it
  /// The residual is larger than the noise: selection stopped at the model error, not at the noise.
  bool limited_by_model = false;
  bool converged = false;
  std::vector<std::string> warnings;
};

/// A vector component that no entry shows (no force in that direction, or no response) is set by reciprocity,
/// with a warning. Directions that only missing entries could connect are taken as uncoupled, with a warning.
///
/// `measured` must be a receptance with at least 8 lines above 0 Hz. Throws InvalidArgument for data that
/// cannot be fitted, NoAnswer when no mode stands out, or the modes leave half of the curves unexplained.
ModalFit fit_modes(const dynamics::FrequencyResponse& measured, const FitOptions& options = {});

}  // namespace stablecut::modal
