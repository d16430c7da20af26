#include "modal/model_choice.h"

#include <array>
#include <cmath>
#include <utility>

#include "modal/mode_search.h"

namespace stablecut::modal {
namespace {

constexpr std::array kModels = {ModeModel::kNonsymmetric, ModeModel::kSymmetric, ModeModel::kProportional};

ModelCriterion criterion_of(const std::vector<GroupFit>& fits, const std::vector<double>& inflation) {
  ModelCriterion criterion;
  criterion.model = fits[0].model;
  for (std::size_t g = 0; g < fits.size(); ++g) {
    const GroupFit& fit = fits[g];
    const auto modes = static_cast<double>(fit.modes().size());
    criterion.modes += fit.modes().size();
    criterion.parameters += modes * fit.parameters_per_mode();
    criterion.chi_square += 2 * fit.refined.chi_square;
    criterion.bic += 2 * fit.refined.chi_square / inflation[g] +
                     modes * fit.parameters_per_mode() * std::log(fit.data.values());
  }
  return criterion;
}

}  // namespace

ChosenFits choose_model(const std::vector<GroupFit>& found, std::optional<ModeModel> wanted,
                        const std::vector<SelectionOptions>& options) {
  std::vector<double> inflation;
  for (const GroupFit& fit : found) inflation.push_back(fit.inflation());
  ChosenFits chosen;
  double least = 0;
  for (const ModeModel model : kModels) {
    if (wanted && model != *wanted) continue;
    std::vector<GroupFit> fits = found;
    for (std::size_t g = 0; g < fits.size(); ++g) {
      if (model != fits[g].model) fits[g] = in_model(std::move(fits[g]), model, options[g]);
    }
    chosen.criteria.push_back(criterion_of(fits, inflation));
    const double bic = chosen.criteria.back().bic;
    if (!chosen.fits.empty() && !(bic < least)) continue;
    least = bic;
    chosen.fits = std::move(fits);
  }
  return chosen;
}

}  // namespace stablecut::modal
