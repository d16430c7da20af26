#include "modal/mode_selection.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numeric>
#include <utility>

#include "modal/mode_candidates.h"

namespace stablecut::modal {
namespace {

// Refinements that only have to tell whether a mode pays.
constexpr Effort kRemoval{40, 0.1}, kAddition{40, 0.1};
constexpr std::size_t kRemovalTrials = 4;  // modes that are tried for removal before a round gives up
// ... and none where an earlier one's factor between both losses puts it as many times above the price.
constexpr double kAsBefore = 2;
constexpr double kBeyondDoubt = 100;  // times the price: no trial where the predicted loss is larger
// What a mode must take away of the residual where the model is the limit: the lesser share above what is
// expected to be left, the larger one below it.
constexpr double kLesserShare = 0.05;
constexpr double kLargerShare = 0.3;
constexpr double kLeastHalfWidth = 0.02;  // of a mode between two lines, in line spacings

// Modes from the least important on; those that are too narrow come first. Residual terms stay.
std::vector<std::size_t> removal_order(const GroupFit& fit) {
  std::vector<std::size_t> order(fit.modes().size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::erase_if(order, [&](std::size_t k) { return fit.data.is_residual(fit.modes()[k].pole()); });
  const auto rank = [&](std::size_t k) {
    return std::pair(!is_too_narrow(fit.data, fit.modes()[k]), fit.refined.removal_loss[k]);
  };
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return rank(a) < rank(b); });
  return order;
}

// The modes without that one; nothing where it is worth its price. `underestimate` is by how much an earlier
// trial's loss was above the second-order one, 0 without a trial.
std::optional<RefinedModes> without_mode(const GroupFit& fit, std::size_t k, bool forced,
                                         double& underestimate) {
  // The second-order loss is a good guess: no trial where it says that the mode matters beyond doubt.
  if (!forced && fit.refined.removal_loss[k] > kBeyondDoubt * price_of_mode(fit, fit.refined, fit.refined))
    return std::nullopt;
  if (!forced &&
      underestimate * fit.refined.removal_loss[k] > kAsBefore * price_of_mode(fit, fit.refined, fit.refined))
    return std::nullopt;
  std::vector<dynamics::Mode> fewer = fit.modes();
  fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(k));
  RefinedModes trial = fit.refine(fewer, kRemoval);
  const double loss = trial.chi_square - fit.refined.chi_square;
  underestimate = loss / fit.refined.removal_loss[k];
  if (!forced && loss >= price_of_mode(fit, fit.refined, trial)) return std::nullopt;
  return trial;
}

// Takes modes away one by one, the least important first, as long as one is not worth its price.
// `underestimates` holds what trials told of each mode (see without_mode).
void remove_modes(GroupFit& fit, std::optional<int> wanted_modes, std::vector<double>& underestimates) {
  const std::size_t least = wanted_modes ? static_cast<std::size_t>(*wanted_modes) : 0;
  while (fit.own_modes() > least) {
    const std::vector<std::size_t> order = removal_order(fit);
    std::optional<RefinedModes> fewer;
    for (std::size_t attempt = 0; attempt < std::min(kRemovalTrials, order.size()) && !fewer; ++attempt) {
      const std::size_t k = order[attempt];
      fewer = without_mode(fit, k, wanted_modes.has_value() || is_too_narrow(fit.data, fit.modes()[k]),
                           underestimates[k]);
      if (fewer) underestimates.erase(underestimates.begin() + static_cast<std::ptrdiff_t>(k));
    }
    if (!fewer) return;
    fit.refined = std::move(*fewer);
  }
}

}  // namespace

double price_of_mode(const GroupFit& fit, const RefinedModes& with, const RefinedModes& without) {
  // [Schwarz1978], and the logarithm of how many lines the mode could have stood on, since noise is searched
  // on all of them.
  const double information = (fit.parameters_per_mode() / 2) * std::log(fit.data.values()) +
                             std::log(static_cast<double>(fit.data.lines()));
  // A residual that is not white prices all modes higher.
  if (fit.regime != Regime::kModelError) return information * fit.inflation_of(with);
  const double share =
      relative_error(fit.data, without.modes) > fit.expected_error() ? kLesserShare : kLargerShare;
  return std::max(information, share * without.chi_square);
}

bool is_too_narrow(const FitData& data, const dynamics::Mode& mode) {
  const std::complex<double> pole = mode.pole();
  return data.in_band(pole) && -pole.real() < kLeastHalfWidth * data.line_spacing();
}

std::optional<RefinedModes> with_another_mode(const GroupFit& fit, std::optional<int> wanted_modes) {
  if (wanted_modes && static_cast<int>(fit.own_modes()) >= *wanted_modes) return std::nullopt;
  std::vector<dynamics::Mode> more = fit.modes();
  more.push_back(best_addition(fit.data, fit.modes()));
  RefinedModes trial = fit.refine(more, kAddition);
  const double gain = fit.refined.chi_square - trial.chi_square;
  const double least_gain = wanted_modes ? 0.0 : price_of_mode(fit, trial, fit.refined);
  if (!(gain > least_gain)) return std::nullopt;
  if (std::any_of(trial.modes.begin(), trial.modes.end(),
                  [&](const dynamics::Mode& mode) { return is_too_narrow(fit.data, mode); }))
    return std::nullopt;
  return trial;
}

void select_modes(GroupFit& fit, const SelectionOptions& options) {
  fit.selection_settled = false;
  std::vector<double> underestimates(fit.modes().size());
  for (int round = 0; round < options.rounds && !fit.selection_settled; ++round) {
    remove_modes(fit, options.wanted_modes, underestimates);
    underestimates.resize(fit.modes().size() + 1);
    if (options.progress) options.progress(std::min(0.99, 0.5 + 0.01 * round));
    std::optional<RefinedModes> more = with_another_mode(fit, options.wanted_modes);
    if (more) fit.refined = std::move(*more);
    fit.selection_settled = !more;
  }
}

}  // namespace stablecut::modal
