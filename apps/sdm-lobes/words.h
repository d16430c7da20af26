// What sdm-lobes says of a chart's accuracy.
#pragma once

#include <string>
#include <vector>

#include "document/kinds/lobes_json.h"

namespace stablecut {

/// Speeds without an answer, an error that is larger than usual, and radii that it leaves open. `advice`
/// stands behind what leaving modes out could mend.
std::vector<std::string> convergence_warnings(const document::LobesDocument& lobes,
                                              const std::string& advice);

}  // namespace stablecut
