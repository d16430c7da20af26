// One pole for the modes of independent directions that have the same one: README.md, "Shared poles".
#pragma once

#include "dynamics/modal_model.h"

namespace stablecut::modal {

/// Gives modes of different directions (none in common, exact zeros) one pole where theirs agree, by the
/// least change of all numbers in the metric of the covariance, which must be known: to first order what a
/// fit of all curves with these poles in common would give. Modes outside the band are left alone. Returns
/// how many modes have got another one's pole.
int share_poles(dynamics::ModalModel& model);

}  // namespace stablecut::modal
