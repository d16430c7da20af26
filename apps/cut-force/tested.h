// --tested: what cuts that were tried say of Kt and Kr.
#pragma once

#include "base/progress.h"
#include "document/kinds/tested_cut_json.h"
#include "document/text/json_text.h"
#include "dynamics/modal_model.h"

namespace stablecut {

/// Fills the posterior of a document that has the rest. Throws NoAnswer where the cuts contradict the prior,
/// or a speed cannot be resolved; DataError, at `source`, where the model has no mode that can chatter.
void learn_from_tested_cuts(const dynamics::ModalModel& model, const document::Source& source, int threads,
                            const Progress& progress, document::TestedCutDocument& document);

}  // namespace stablecut
