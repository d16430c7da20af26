// Parts of the kinds `pose` and `pose-path`: a cut's forces, and how a pose yields under them.
#pragma once

#include "document/text/json_text.h"
#include "robot/cut_deflection.h"

namespace stablecut::document {

/// Field `cut` of a document.
Json cut_load_to_json(const robot::CutLoad& cut);

/// Field `cut` of a pose.
Json cut_deflection_to_json(const robot::CutDeflection& deflection);

}  // namespace stablecut::document
