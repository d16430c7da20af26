// The words of fit-modes: what a finding means for its user, and which of its options helps.
#pragma once

#include <string>

#include "dynamics/modal_model.h"
#include "modal/fit.h"
#include "modal/record_end.h"
#include "modal/tap_checks.h"

namespace stablecut {

/// That the low end up to `hz` was left out of the fit: it `falls` as no modes explain, or it was in doubt
/// and there was no answer with it.
std::string left_out_text(double hz, bool falls);

/// `band_chosen`: the user says which lines count, so that none are left out at the low end.
std::string words_of(const modal::TapFinding& finding, bool band_chosen);
std::string words_of(const modal::FitFinding& finding);

/// Which of the table's modes its own deviations leave untold; empty where none.
std::string untold_text(const dynamics::ModalModel& table);

std::string ringing_text(const modal::RingingModes& ringing);

}  // namespace stablecut
