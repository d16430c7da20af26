// Kind `mode-comparison`: two modal tables side by side.
#pragma once

#include <string>
#include <vector>

#include "document/text/json_text.h"
#include "dynamics/mode_comparison.h"

namespace stablecut::document {

struct ComparedTable {
  dynamics::ModalModel model;
  std::vector<std::string> labels;  ///< of its modes, empty where they have none
};

/// The document without provenance; modes are numbered from 1, as in their tables.
Json mode_comparison_to_json(const dynamics::ModeComparison& comparison, const ComparedTable& first,
                             const ComparedTable& second);

}  // namespace stablecut::document
