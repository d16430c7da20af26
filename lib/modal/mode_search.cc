#include "modal/mode_search.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "modal/shared_noise.h"
#include "modal/start_modes.h"

namespace stablecut::modal {
namespace {

constexpr int kSplitsAndFits = 12;  // of noise that curves share, until both are settled
// Of refinements between changes of the weights, of the last ones on the way, and of the final one.
constexpr Effort kBetween{60, 0.01}, kLast{240, 1e-5}, kFinal{960, 1e-5};
constexpr int kParts = 4;    // of a refinement that may be given up
constexpr int kRescues = 3;  // modes that may be added before the noise is given up

GroupFit weighted(FitData data, CurveVariances given) {
  GroupFit fit;
  fit.noise_estimated = given.empty();
  fit.variance = given.empty() ? scatter_of_curves(data) : std::move(given);
  fit.data = std::move(data);
  fit.weigh(Regime::kNoise);
  return fit;
}

// Noise from what the modes leave.
void estimate_noise(GroupFit& fit) {
  fit.variance = scatter_of_residual(fit.data, fit.modes());
  fit.weigh(fit.regime);
  fit.refined = fit.refine(fit.modes(), kBetween);
}

// Whether steps that each bring as much as the one from `before` could not reach the noise in so many more.
bool out_of_reach(const GroupFit& fit, double before, int more) {
  const double now = fit.refined.chi_square;
  return fit.exceeds_noise(now * std::pow(now / before, more));
}

// As kLast, as long as it comes near the noise.
void refine_towards_noise(GroupFit& fit) {
  for (int part = kParts; part-- > 0 && fit.exceeds_noise();) {
    const double before = fit.refined.chi_square;
    fit.refined = fit.refine(fit.modes(), {kLast.iterations / kParts, kLast.tolerance});
    if (out_of_reach(fit, before, part)) return;
  }
}

// Where the residual exceeds the noise, the first refinement may have been stopped, or a few modes may have
// been overlooked. If it is neither, weighing modes against noise makes no sense.
void rescue(GroupFit& fit, const SelectionOptions& options) {
  refine_towards_noise(fit);
  for (int more = kRescues; more-- > 0 && fit.exceeds_noise();) {
    std::optional<RefinedModes> with = with_another_mode(fit, options.wanted_modes);
    if (!with) return;
    const double before = fit.refined.chi_square;
    fit.refined = std::move(*with);
    if (out_of_reach(fit, before, more)) return;
  }
}

// Whether curves share errors in one of the two and not in the other.
bool tell_otherwise(const CurveVariances& a, const CurveVariances& b) {
  const auto tells = [](const CurveVariances& shared, std::size_t c) {
    return c < shared.size() && shared[c].size() > 0;
  };
  for (std::size_t c = 0; c < std::max(a.size(), b.size()); ++c)
    if (tells(a, c) != tells(b, c)) return true;
  return false;
}

// The modes have taken some of the noise with them: values over degrees of freedom.
double correction_of(const GroupFit& fit) {
  const double values = fit.data.values();
  const double parameters = fit.parameters_per_mode() * static_cast<double>(fit.modes().size());
  return values / std::max(values - parameters, 1.0);
}

// What curves have of their own.
CurveVariances own_parts(const GroupFit& fit) {
  CurveVariances own = fit.variance;
  for (std::size_t c = 0; c < fit.shared.size(); ++c)
    if (fit.shared[c].size() > 0) own[c] -= fit.shared[c];
  return own;
}

// Where curves share nearly all of their noise, the first modes, of independent errors, are off by more than
// what curves have of their own: split and fit again until that no longer falls.
GroupFit with_settled_split(GroupFit fit) {
  for (int i = 0; i < kSplitsAndFits && tell_otherwise(fit.shared, {}); ++i) {
    const CurveVariances before = own_parts(fit);
    const double correction = correction_of(fit);
    GroupFit next = fit;
    if (next.noise_estimated)
      next.variance = residual_as_noise(fit.data, fit.modes(), correction, true).variance;
    next.shared = shared_noise(fit.data, fit.modes(), correction, true, next.variance);
    if (!differ_much(own_parts(next), before)) break;
    fit = std::move(next);
    fit.weigh(fit.regime);
    fit.refined = fit.refine(fit.modes(), kBetween);
  }
  return fit;
}

// Noise once the modes are known, from all of the residual: the fewer numbers describe it, the surer the
// weights. What smooth shapes do not describe may be modes; when these have been looked for, it is noise of
// that place.
GroupFit with_settled_noise(GroupFit fit, const SelectionOptions& options) {
  for (const bool local_allowed : {false, true}) {
    const double correction = correction_of(fit);
    ResidualVariances now = residual_as_noise(fit.data, fit.modes(), correction, local_allowed);
    CurveVariances shared = shared_noise(fit.data, fit.modes(), correction, local_allowed, now.variance);
    const bool changed = differ_much(now.variance, fit.variance) || tell_otherwise(shared, fit.shared);
    fit.variance = std::move(now.variance);
    fit.shared = std::move(shared);
    fit.weigh(fit.regime);
    fit.refined = fit.refine(fit.modes(), kBetween);
    if (changed) select_modes(fit, options);
    if (!now.is_local) break;
  }
  return with_settled_split(std::move(fit));
}

// A given variance says nothing of what curves share: where they do, the residual tells both parts.
GroupFit with_shared_noise(GroupFit fit, const SelectionOptions& options) {
  for (const bool local_allowed : {false, true}) {
    const bool known = tell_otherwise(fit.shared, {});
    fit.shared = shared_noise(fit.data, fit.modes(), correction_of(fit), local_allowed, fit.variance);
    if (!known && !tell_otherwise(fit.shared, {})) return fit;
    fit.weigh(fit.regime);
    fit.refined = fit.refine(fit.modes(), kBetween);
    if (!known) select_modes(fit, options);
  }
  return with_settled_split(std::move(fit));
}

// Nearly no noise: the same again with all that the numbers hold, unless the model cannot follow that far.
GroupFit without_noise(const GroupFit& coarse, const SelectionOptions& options) {
  GroupFit fine = coarse;
  fine.weigh(Regime::kNoiseless);
  fine.refined = fine.refine(fine.modes(), kBetween);
  if (fine.noise_estimated) estimate_noise(fine);
  select_modes(fine, options);
  if (!fine.exceeds_noise()) return fine;
  // The modes as they were, with what the attempt told of the noise.
  GroupFit result = coarse;
  result.variance = fine.variance;
  result.weigh(coarse.regime);
  return result;
}

// No sum of modes reaches the noise: curves weigh by their size, and modes are found from the strongest on.
GroupFit from_strongest(GroupFit fit, const SelectionOptions& options) {
  fit.weigh(Regime::kModelError);
  if (options.poles.size() == 0)
    fit.refined.modes = fit.data.residual_terms ? modes_at(fit.data, residual_poles(fit.data))
                                                : std::vector<dynamics::Mode>{};
  fit.refined = fit.refine(fit.modes(), kLast);
  select_modes(fit, options);
  // It may have been the way to the noise that failed, not the model.
  GroupFit noisy = fit;
  noisy.weigh(Regime::kNoise);
  noisy.refined = noisy.refine(noisy.modes(), kBetween);
  refine_towards_noise(noisy);
  if (noisy.exceeds_noise()) return fit;
  if (floors_decide(noisy.data, noisy.regime)) return without_noise(noisy, options);
  if (!noisy.residual_is_white()) return fit;
  select_modes(noisy, options);
  return noisy;
}

// What limits the modes that were selected against the noise: the noise, the digits, or the model.
GroupFit settled(GroupFit fit, const SelectionOptions& options) {
  if (fit.exceeds_noise()) return from_strongest(std::move(fit), options);
  if (floors_decide(fit.data, fit.regime)) return without_noise(fit, options);
  if (!fit.noise_estimated) return with_shared_noise(std::move(fit), options);
  GroupFit result = with_settled_noise(fit, options);
  if (result.residual_is_white() && !result.is_crowded() && !result.has_helpers()) return result;
  return from_strongest(std::move(fit), options);
}

// The last refinement may still make a mode too narrow to be one, but for modes at given poles.
void refine_to_the_end(GroupFit& fit, const SelectionOptions& options) {
  fit.refined = fit.refine(fit.modes(), kFinal);
  if (options.poles.size() > 0) return;
  const auto is_narrow = [&](const dynamics::Mode& mode) { return is_too_narrow(fit.data, mode); };
  while (std::any_of(fit.modes().begin(), fit.modes().end(), is_narrow)) {
    std::vector<dynamics::Mode> wider = fit.modes();
    std::erase_if(wider, is_narrow);
    fit.refined = fit.refine(wider, kFinal);
  }
}

}  // namespace

GroupFit search_modes(FitData data, CurveVariances variance, const SelectionOptions& options) {
  GroupFit fit = weighted(std::move(data), std::move(variance));
  if (options.poles.size() > 0) {
    fit.start_poles = options.poles;
    fit.refined = fit.refine(modes_at(fit.data, fit.start_poles), kLast);
  } else {
    fit.start_poles = options.starts.size() > 0 ? options.starts : find_poles(fit);
    fit.refined = start_modes(fit, fit.start_poles);
  }
  if (fit.noise_estimated) estimate_noise(fit);
  rescue(fit, options);
  if (fit.exceeds_noise() && !fit.noise_estimated) {
    // The variance that came with the data may be too small: see what the residual says of the noise.
    fit.noise_estimated = true;
    estimate_noise(fit);
    rescue(fit, options);
  }
  if (!fit.exceeds_noise()) select_modes(fit, options);
  fit = settled(std::move(fit), options);
  refine_to_the_end(fit, options);
  return fit;
}

GroupFit in_model(GroupFit fit, ModeModel model, const SelectionOptions& options) {
  fit.model = model;
  refine_to_the_end(fit, options);
  if (!fit.exceeds_noise()) {
    select_modes(fit, options);
    refine_to_the_end(fit, options);
  }
  // The weights stay: all models are judged by the same.
  if (fit.exceeds_noise()) fit.regime = Regime::kModelError;
  return fit;
}

}  // namespace stablecut::modal
