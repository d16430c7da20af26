// Noise that the curves of one reference share, as that of the hammer's channel: README.md, "Errors that
// entries share".
#pragma once

#include <vector>

#include "dynamics/modal_model.h"
#include "modal/fit_data.h"
#include "modal/noise_weights.h"

namespace stablecut::modal {

/// Estimates from what modes leave of the curves which part of the noise the curves of one reference share:
/// an error in proportion to each curve, one for each reference and line. `variance` [curves][lines] is that
/// of the whole noise; where something is shared it becomes the sum of both parts, estimated together and
/// multiplied by `correction`, the number of values over the degrees of freedom. With `local_allowed` the own
/// part may follow a running mean. Where the errors are not likelier with a shared part than with `variance`
/// as it is, nothing is shared. Gives the variance of the shared part
/// [curves][lines], empty for a curve that shares nothing as far as can be told.
CurveVariances shared_noise(const FitData& data, const std::vector<dynamics::Mode>& modes, double correction,
                            bool local_allowed, CurveVariances& variance);

}  // namespace stablecut::modal
