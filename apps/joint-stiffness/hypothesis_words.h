// What is most often wrong with loads and deflections: --apply, and what joint-stiffness says of it.
#pragma once

#include <string>
#include <vector>

#include "document/kinds/load_samples_json.h"
#include "robot/hypotheses.h"
#include "robot/identification.h"

namespace stablecut {

/// Makes the changes that --apply names, in their order; those with a fitted vector are fitted to the samples
/// as they then are. Returns them. Throws WrongUsage for a name that there is not.
std::vector<robot::Hypothesis> apply_named(const std::vector<std::string>& names, robot::Robot& robot,
                                           document::LoadSamplesDocument& samples,
                                           const std::array<bool, 3>& components);

/// What was looked at beside the identification itself.
struct SecondLook {
  std::vector<robot::BetterFit> better;
  robot::StiffnessOfReach stiffness;  ///< with the best of them
};

SecondLook second_look(const robot::Robot& robot, const document::LoadSamplesDocument& samples,
                       const std::array<bool, 3>& components);

/// Warnings of it, without the samples' name.
std::vector<std::string> hypothesis_warnings(const SecondLook& look, const robot::Robot& robot,
                                             const document::LoadSamplesDocument& samples);

/// A warning where the residual is so large beside the deflection that the model hardly predicts it; else
/// empty.
std::string misfit_warning(const robot::Identification& found);

}  // namespace stablecut
