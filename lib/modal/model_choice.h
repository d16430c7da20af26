// Which of the three mode models explains the curves best for its parameters: README.md, "Models".
#pragma once

#include <optional>
#include <vector>

#include "modal/group_fit.h"
#include "modal/mode_selection.h"

namespace stablecut::modal {

/// What decides between models: Schwarz' criterion [Schwarz1978] chi_square / inflation + parameters
/// log(values), smaller is better. Sums over all groups of directions.
struct ModelCriterion {
  ModeModel model = ModeModel::kNonsymmetric;
  std::size_t modes = 0;
  double parameters = 0;
  double chi_square = 0;  ///< sum over real and imaginary parts of squares over their variance
  double bic = 0;
};

/// A model's fits, one a group.
struct ChosenFits {
  std::vector<GroupFit> fits;
  std::vector<ModelCriterion> criteria;  ///< of every model that was tried
};

/// The groups' fits, found in the nonsymmetric model, in the model that is wanted, else in the best. All
/// models are judged by the noise, and the inflation, that the nonsymmetric one left. `options` [groups].
ChosenFits choose_model(const std::vector<GroupFit>& found, std::optional<ModeModel> wanted,
                        const std::vector<SelectionOptions>& options);

}  // namespace stablecut::modal
