#include "modal/fit.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>

#include "base/error.h"
#include "base/number_text.h"
#include "base/units.h"
#include "modal/curve_groups.h"
#include "modal/explained.h"
#include "modal/fitted_table.h"
#include "modal/mismatch_proof.h"
#include "modal/mode_search.h"
#include "modal/shared_poles.h"
#include "modal/table_assembly.h"

namespace stablecut::modal {
namespace {

using Complex = std::complex<double>;

constexpr Eigen::Index kLeastLines = 8;
// m/N; what is outside is an error of units, or of a line.
constexpr double kLeastReceptance = 1e-40, kLargestReceptance = 1e40;
constexpr double kNoFit = 0.5;  // relative error from which on modes explain nothing

// ---- check ----

void check(const dynamics::FrequencyResponse& measured) {
  if (measured.quantity != dynamics::Quantity::kReceptance) throw InvalidArgument("expected a receptance");
  if (measured.frequency_hz.size() < kLeastLines || measured.frequency_hz[0] < 0) {
    throw InvalidArgument("expected at least " + std::to_string(kLeastLines) +
                          " lines to fit modes to, not " + std::to_string(measured.frequency_hz.size()));
  }
  for (const auto& entry : measured.entries) {
    const double largest = entry.h.cwiseAbs().maxCoeff();
    if (largest == 0 || (largest > kLeastReceptance && largest < kLargestReceptance)) continue;
    throw InvalidArgument(entry.response + entry.reference +
                          ": expected receptances of a usual size in m/N, not up to " + number_text(largest));
  }
}

// ---- search ----

SelectionOptions selection_of(const CurveGroup& group, const Progress& progress) {
  SelectionOptions options{group.wanted_modes, progress};
  options.poles = group.poles;
  return options;
}

ChosenFits search(const std::vector<CurveGroup>& groups, const FitOptions& options) {
  std::vector<GroupFit> found;
  std::vector<SelectionOptions> selections;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    selections.push_back(selection_of(groups[g], options.progress));
    // A round tool in a round spindle: the same numbers in y as in x need no second fit.
    const auto same = std::find_if(groups.begin(), groups.begin() + static_cast<std::ptrdiff_t>(g),
                                   [&](const CurveGroup& other) { return alike(other, groups[g]); });
    const std::size_t at = same - groups.begin();
    found.push_back(at < g ? found[at] : search_modes(groups[g].data, groups[g].variance, selections.back()));
  }
  return choose_model(found, options.model, selections);
}

// ---- assemble ----

std::optional<Reciprocity> reciprocity_of(const std::vector<GroupFit>& fits) {
  double difference = 0, sizes = 0, noise = 0;
  for (const GroupFit& fit : fits) {
    for (const Curve& a : fit.data.curves) {
      for (const Curve& b : fit.data.curves) {
        if (a.response >= a.reference || b.response != a.reference || b.reference != a.response) continue;
        difference += (a.h - b.h).squaredNorm();
        sizes += std::pow(a.h.norm() + b.h.norm(), 2);
        noise += (a.weight.cwiseInverse() + b.weight.cwiseInverse()).sum();
      }
    }
  }
  if (sizes == 0) return std::nullopt;
  return Reciprocity{std::sqrt(difference / sizes), std::sqrt(noise / sizes)};
}

// How well each curve is met, and all together.
void add_curve_fits(const std::vector<CurveGroup>& groups, const std::vector<GroupFit>& fits, ModalFit& fit) {
  double error_square = 0, square = 0;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    for (const Curve& curve : fits[g].data.curves) {
      const Eigen::VectorXcd error = curve_of(fits[g].modes(), curve, fits[g].data.s) - curve.h;
      error_square += error.squaredNorm();
      square += curve.h.squaredNorm();
      fit.curves.push_back({groups[g].directions[curve.response], groups[g].directions[curve.reference],
                            curve.h.isZero(0) ? 0.0 : error.norm() / curve.h.norm(),
                            error.cwiseAbs2().dot(curve.weight) / static_cast<double>(error.size())});
    }
  }
  fit.relative_error = std::sqrt(error_square / square);
}

ModalFit assemble(const dynamics::FrequencyResponse& measured, const std::vector<CurveGroup>& groups,
                  const FitOptions& options, const ChosenFits& chosen) {
  ModalFit fit;
  fit.model.dofs = direction_names(measured);
  fit.criteria = chosen.criteria;
  fit.mode_model = chosen.fits[0].model;
  fit.reciprocity = reciprocity_of(chosen.fits);
  fit.variance_given = fit.converged = true;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const GroupFit& part = chosen.fits[g];
    fit.variance_given = fit.variance_given && !part.noise_estimated;
    fit.converged = fit.converged && part.refined.converged;
    fit.limited_by_model = fit.limited_by_model || part.regime == Regime::kModelError;
    fit.inflation = std::max(fit.inflation, part.inflation());
    const FittedTable table =
        fitted_table(part.data, part.modes(), part.model, part.regime != Regime::kModelError);
    fit.by_reciprocity = fit.by_reciprocity || table.by_reciprocity;
    add_to_table(table, groups[g].directions, part.inflation(), fit.model);
    fit.data.push_back(part.data);
  }
  for (dynamics::Mode& mode : fit.model.modes) mode.out_of_band = !fit.data[0].in_band(mode.pole());
  if (options.share_poles) fit.shared_poles = share_poles(fit.model);
  fit.model = sorted_by_frequency(fit.model);
  add_curve_fits(groups, chosen.fits, fit);
  fit.reduced_chi_square = reduced_chi_square_of(chosen.fits);
  return fit;
}

// ---- judge ----

// Entries that the measurement does not have although it has both of their directions.
std::vector<EntryName> missing_entries(const dynamics::FrequencyResponse& measured,
                                       const std::vector<std::string>& dofs) {
  std::vector<EntryName> missing;
  for (const std::string& response : dofs) {
    for (const std::string& reference : dofs) {
      if (measured.find(response, reference) == nullptr) missing.push_back({response, reference});
    }
  }
  return missing;
}

// Which curves are driving points.
std::vector<bool> driving_points(const dynamics::FrequencyResponse& measured, const CurveGroup& group,
                                 const FitData& data) {
  std::vector<bool> driving;
  for (const Curve& curve : data.curves)
    driving.push_back(measured.find(group.directions[curve.response], group.directions[curve.reference])
                          ->is_driving_point());
  return driving;
}

// Entries that come late, or whose scale is off.
void judge_entries(const dynamics::FrequencyResponse& measured, const std::vector<CurveGroup>& groups,
                   const std::vector<GroupFit>& fits, ModalFit& fit) {
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const FitData& data = fits[g].data;
    const auto name = [&](std::size_t c) {
      return EntryName{groups[g].directions[data.curves[c].response],
                       groups[g].directions[data.curves[c].reference]};
    };
    for (const EntryMismatch& mismatch :
         proved_mismatches(fits[g], groups[g].variance, driving_points(measured, groups[g], data),
                           selection_of(groups[g], {}))) {
      FitFinding finding{.kind = mismatch.all           ? FitFindingKind::kAllDelayed
                                 : mismatch.factor != 1 ? FitFindingKind::kScaled
                                                        : FitFindingKind::kDelayed,
                         .missing = {name(mismatch.curve)},
                         .delay_s = mismatch.delay_s,
                         .factor = mismatch.factor};
      if (mismatch.other) {
        const EntryName one = name(mismatch.curve), other = name(*mismatch.other);
        finding.missing.push_back(other);
        if (mismatch.or_cross) {
          finding.missing.push_back({one.response, other.response});
          finding.missing.push_back({other.response, one.response});
        }
      }
      fit.findings.push_back(std::move(finding));
    }
  }
}

// Modes that are reciprocal but for one factor; nothing more where entries do not fit together.
void judge_reciprocity(ModalFit& fit) {
  for (const FitFinding& finding : fit.findings)
    if (finding.kind == FitFindingKind::kScaled || finding.kind == FitFindingKind::kDelayed) return;
  for (const ReciprocityFactor& factor : reciprocity_factors(fit.model)) {
    const std::string &i = fit.model.dofs[factor.i], &j = fit.model.dofs[factor.j];
    fit.findings.push_back(
        {.kind = FitFindingKind::kOneFactor, .missing = {{i, j}, {j, i}}, .reciprocity = factor});
  }
}

// Natural frequencies that differ between forces, or between responses.
void judge_poles(const std::vector<CurveGroup>& groups, const std::vector<GroupFit>& fits, ModalFit& fit) {
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const auto shift = pole_shift(fits[g]);
    if (!shift) continue;
    std::vector<std::string> names = groups[g].directions;  // the shifted one first
    std::swap(names[0], names[shift->direction]);
    fit.findings.push_back(
        {.kind = FitFindingKind::kShifted, .shift = *shift, .directions = std::move(names)});
  }
}

// What the modes leave of all curves, beyond their noise: |model - h| / |h|, norms over lines and curves.
double error_beyond_noise(const std::vector<GroupFit>& fits) {
  double left = 0, square = 0;
  for (const GroupFit& fit : fits) {
    for (std::size_t c = 0; c < fit.data.curves.size(); ++c) {
      const Curve& curve = fit.data.curves[c];
      const double error = (curve_of(fit.modes(), curve, fit.data.s) - curve.h).squaredNorm();
      left += std::max(error - fit.variance[c].sum(), 0.0);
      square += curve.h.squaredNorm();
    }
  }
  return std::sqrt(left / square);
}

// Where modes explain too little of a curve or a band, whatever limits the fit, or there is none in the band.
void judge_explained(const dynamics::FrequencyResponse& measured, const std::vector<CurveGroup>& groups,
                     const std::vector<GroupFit>& fits, const FitOptions& options, ModalFit& fit) {
  const bool restricted = fit.mode_model != ModeModel::kNonsymmetric;
  if (std::all_of(fit.model.modes.begin(), fit.model.modes.end(),
                  [](const dynamics::Mode& mode) { return mode.out_of_band; }))
    fit.findings.push_back({.kind = FitFindingKind::kNoMode});
  if (options.modes || !options.poles.empty()) return;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    if (!leave_low_end(fits[g].data, fits[g].modes(), driving_points(measured, groups[g], fits[g].data),
                       options.falls_to_hz, kNoFit))
      continue;
    fit.findings.push_back({.kind = FitFindingKind::kLowEndLeft, .hi_hz = options.falls_to_hz});
    break;
  }
  if (const double left = fit.limited_by_model ? error_beyond_noise(fits) : 0; left > kNoFit) {
    fit.findings.push_back({.kind = FitFindingKind::kUnexplained, .error = left, .restricted = restricted});
    return;
  }
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const auto worst = most_unexplained(fits[g].data, fits[g].modes(), kNoFit);
    if (!worst) continue;
    const Curve& curve = fits[g].data.curves[worst->curve];
    fit.findings.push_back(
        {.kind = FitFindingKind::kUnexplained,
         .missing = {{groups[g].directions[curve.response], groups[g].directions[curve.reference]}},
         .error = worst->error,
         .restricted = restricted,
         .lo_hz = worst->lo_hz,
         .hi_hz = worst->hi_hz});
  }
}

// What says that a fit is no answer.
void judge_answer(const dynamics::FrequencyResponse& measured, const std::vector<CurveGroup>& groups,
                  const std::vector<GroupFit>& fits, const FitOptions& options, ModalFit& fit) {
  if (!fit.converged) fit.findings.push_back({.kind = FitFindingKind::kNotConverged});
  judge_explained(measured, groups, fits, options, fit);
}

// All else that a user should know, before what judge_answer found.
void judge(const dynamics::FrequencyResponse& measured, const std::vector<CurveGroup>& groups,
           const std::vector<GroupFit>& fits, const FitOptions& options, ModalFit& fit) {
  std::vector<FitFinding> of_answer = std::exchange(fit.findings, {});
  std::size_t modes = 0;
  for (const GroupFit& part : fits) modes += part.own_modes();
  for (std::size_t g = 0; g < groups.size(); ++g) {
    if (!groups[g].variance.empty() && fits[g].noise_estimated)
      fit.findings.push_back({.kind = FitFindingKind::kVarianceTooSmall});
  }
  if (std::any_of(fits.begin(), fits.end(), [](const GroupFit& f) { return !f.selection_settled; })) {
    fit.findings.push_back({.kind = FitFindingKind::kSelectionUnsettled, .modes = modes});
  } else if (options.modes && static_cast<int>(modes) < *options.modes) {
    fit.findings.push_back({.kind = FitFindingKind::kFewerModes, .modes = modes});
  }
  const std::vector<EntryName> missing = missing_entries(measured, fit.model.dofs);
  if (fit.by_reciprocity) {
    fit.findings.push_back({.kind = FitFindingKind::kByReciprocity, .missing = missing});
  } else if (!missing.empty() && groups.size() > 1) {
    fit.findings.push_back({.kind = FitFindingKind::kTakenAsUncoupled, .missing = missing});
  }
  judge_entries(measured, groups, fits, fit);
  // Responses that come late have phases like drift's.
  if (std::any_of(fit.findings.begin(), fit.findings.end(), [](const FitFinding& finding) {
        return finding.kind == FitFindingKind::kDelayed || finding.kind == FitFindingKind::kAllDelayed;
      }))
    std::erase_if(of_answer,
                  [](const FitFinding& finding) { return finding.kind == FitFindingKind::kLowEndLeft; });
  judge_reciprocity(fit);
  judge_poles(groups, fits, fit);
  if (fit.limited_by_model) {
    fit.findings.push_back({.kind = FitFindingKind::kModelError,
                            .error = fit.relative_error,
                            .restricted = fit.mode_model != ModeModel::kNonsymmetric});
  }
  fit.findings.insert(fit.findings.end(), of_answer.begin(), of_answer.end());
}

struct Attempt {
  std::vector<GroupFit> fits;
  ModalFit fit;  // its findings are those of judge_answer
};

Attempt attempt(const dynamics::FrequencyResponse& measured, const std::vector<CurveGroup>& groups,
                const FitOptions& options) {
  ChosenFits chosen = search(groups, options);
  ModalFit fit = assemble(measured, groups, options, chosen);
  judge_answer(measured, groups, chosen.fits, options, fit);
  return {std::move(chosen.fits), std::move(fit)};
}

}  // namespace

bool is_no_answer(FitFindingKind kind) {
  return kind == FitFindingKind::kNoMode || kind == FitFindingKind::kNotConverged ||
         kind == FitFindingKind::kUnexplained;
}

bool has_answer(const ModalFit& fit) {
  return std::none_of(fit.findings.begin(), fit.findings.end(),
                      [](const FitFinding& finding) { return is_no_answer(finding.kind); });
}

ModalFit fit_modes(const dynamics::FrequencyResponse& measured, const FitOptions& options) {
  check(measured);
  std::vector<CurveGroup> groups = curve_groups(measured, options);
  Attempt best = attempt(measured, groups, options);
  if (best.fit.limited_by_model && !has_answer(best.fit)) {
    // The strongest modes may be those of a soft robot, a hundred times larger than the tool's: octave by
    // octave.
    for (CurveGroup& group : groups) group.data.levelled = true;
    if (Attempt levelled = attempt(measured, groups, options); has_answer(levelled.fit))
      best = std::move(levelled);
  }
  judge(measured, groups, best.fits, options, best.fit);
  return std::move(best.fit);
}

}  // namespace stablecut::modal
