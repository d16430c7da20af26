// The words of fit-modes: what a finding means for its user, and which of its options helps.
#pragma once

#include <string>

#include "modal/fit.h"
#include "modal/tap_checks.h"

namespace stablecut {

std::string words_of(const modal::TapFinding& finding);
std::string words_of(const modal::FitFinding& finding);

}  // namespace stablecut
