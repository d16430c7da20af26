// What fits loads and deflections better, and what was changed: parts of kind `joint-stiffness`.
#pragma once

#include <string>
#include <vector>

#include "document/kinds/load_samples_json.h"
#include "robot/hypotheses.h"

namespace stablecut::document {

/// The units that deflections and forces may be in, other than those that the file states.
robot::HypothesisOptions hypothesis_options(const LoadSamplesDocument& samples,
                                            const std::array<bool, 3>& components);

/// What --apply calls it: sign:A3, coupling:A3=-1, turned:x90, turned, angles:rad, load-point, length:A4,
/// deflection:um, force:kgf.
std::string hypothesis_name(const robot::Hypothesis& hypothesis, const robot::Robot& robot,
                            const LoadSamplesDocument& samples);

/// List `applied`: names, and what was fitted.
Json applied_to_json(const std::vector<robot::Hypothesis>& applied, const robot::Robot& robot,
                     const LoadSamplesDocument& samples);

/// List `hypotheses`: what fits far better.
Json better_fits_to_json(const std::vector<robot::BetterFit>& better, const robot::Robot& robot,
                         const LoadSamplesDocument& samples);

}  // namespace stablecut::document
