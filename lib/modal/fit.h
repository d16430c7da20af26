// From measured receptances to a table of modes, without any guess by the user: README.md, "From curves to a
// table".
#pragma once

#include <complex>
#include <optional>
#include <string>
#include <vector>

#include "base/progress.h"
#include "dynamics/frequency_response.h"
#include "dynamics/modal_model.h"
#include "modal/entry_name.h"
#include "modal/fit_data.h"
#include "modal/model_choice.h"
#include "modal/pole_shift.h"
#include "modal/reciprocity_factor.h"

namespace stablecut::modal {

/// A pole that is known.
struct GivenPole {
  std::complex<double> pole;            ///< rad/s, with a positive imaginary part; without a window's decay
  std::vector<std::string> directions;  ///< those that it moves; empty: all
};

struct FitOptions {
  std::optional<int> modes;  ///< how many, instead of finding out; shared evenly among independent groups
  /// Empty: the one of the three with the least information criterion.
  std::optional<ModeModel> model = ModeModel::kNonsymmetric;
  Progress progress;
  /// Modes at these poles, and no others; empty: found in the curves. With `modes` empty.
  std::vector<GivenPole> poles{};
  bool share_poles = false;  ///< of independent groups, where they agree; not with poles_fixed
  bool poles_fixed = false;  ///< keep them as they are; else they are where the refinement starts
  /// What lies outside the band is fixed terms, one below and one above for each direction, in place of modes
  /// there: `modes` and `poles` are those in the band.
  bool residual_terms = false;
  /// Up to here curves fall from the first line on (Hz): what modes leave there is a finding. 0: none do.
  double falls_to_hz = 0;
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

/// Which fields of a FitFinding a kind sets stands behind it.
enum class FitFindingKind {
  kVarianceTooSmall,    ///< the residual of a group is much larger than the given variance: it was estimated
                        ///< instead
  kFewerModes,          ///< only `modes` could be told apart, fewer than wanted
  kSelectionUnsettled,  ///< the selection was ended after its last round, with `modes` in all
  kByReciprocity,       ///< entries `missing`: what they would tell follows by reciprocity, or is zero
  kTakenAsUncoupled,    ///< entries `missing` alone could connect some directions
  kDelayed,             ///< the response of entry missing[0] comes `delay_s` late
  kAllDelayed,          ///< the responses of all entries do, as far as can be told
  kScaled,              ///< entry missing[0], or else missing[1], is `factor` times what fits the others
  kOneFactor,           ///< entry missing[0] is `reciprocity` times missing[1] in all modes
  kShifted,             ///< natural frequencies of the curves of directions[0], as `shift` has it
  kLowEndLeft,          ///< up to `hi_hz` curves fall as those of no structure do
  // Of these a table is no answer (is_no_answer):
  kNoMode,        ///< none in the band stands out of the noise
  kNotConverged,  ///< the last refinement of some group
  kUnexplained,   ///< modes leave `error` of entry missing[0] from `lo_hz` to `hi_hz`, or of all curves
  /// The residual is larger than the noise or not white, and leaves the share `error` of the curves: of modes
  /// as a restricted model has them (`restricted`), or of the strongest modes.
  kModelError
};

/// What a user should know about a fit.
struct FitFinding {
  FitFindingKind kind;
  std::size_t modes = 0;
  std::vector<EntryName> missing{};  ///< entries that are missing, or that the finding is about
  double error = 0;
  bool restricted = false;
  double delay_s = 0, factor = 1;
  double lo_hz = 0, hi_hz = 0;
  PoleShift shift{};
  ReciprocityFactor reciprocity{};
  std::vector<std::string> directions{};  ///< the one that it is about, then the others
};

/// Whether what was fitted is no answer: nobody should cut with that table.
bool is_no_answer(FitFindingKind kind);

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
  double relative_error = 0;  ///< over all curves together
  double reduced_chi_square =
      0;                        ///< chi-square over the degrees of freedom: 1 when noise is all that is left
  bool variance_given = false;  ///< the noise came with the measurement; otherwise it was estimated from it
  /// The residual is larger than the noise: selection stopped at the model error, not at the noise.
  bool limited_by_model = false;
  bool converged = false;       ///< the last refinement of every group
  int shared_poles = 0;         ///< modes that have got the pole of one of another group
  bool by_reciprocity = false;  ///< some vector components are shown by no entry
  std::vector<FitFinding> findings;
};

/// Whether none of the findings says that it is no answer.
bool has_answer(const ModalFit& fit);

/// Fits modes to a receptance (m/N) with at least 8 lines above 0 Hz. A vector component that no entry shows
/// (no force in that direction, or no response) is set by reciprocity; directions that only missing entries
/// could connect are taken as uncoupled; both are findings.
///
/// Throws InvalidArgument for data that cannot be fitted, and for poles of which none moves some curve, two
/// are the same, or that are more than half of the lines; NoAnswer when all entries are zero. What was found
/// may be no answer even so: see is_no_answer.
ModalFit fit_modes(const dynamics::FrequencyResponse& measured, const FitOptions& options = {});

}  // namespace stablecut::modal
