// The options of fit-modes with which the user can do something about a finding.
#pragma once

#include <string>

#include "base/error.h"

namespace stablecut {

/// Its name, empty for none.
std::string option_of(Remedy remedy);

}  // namespace stablecut
