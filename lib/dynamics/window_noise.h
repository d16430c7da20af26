// What the noise of neighbouring lines has in common through an exponential window: README.md, "Exponential
// window".
#pragma once

#include "dynamics/frequency_response.h"
#include "dynamics/modal_model.h"

namespace stablecut::dynamics {

/// A model that was fitted to `measured` (poles with the window's damping) as if the errors of its lines were
/// independent, with the covariance that it has where white noise went through the window too, over records
/// as long as the least distance of lines tells. Deviations of poles and of vectors grow by the factors that
/// are exact for a mode that stands alone; correlations stay. Without a window nothing changes.
ModalModel with_window_noise(ModalModel model, const FrequencyResponse& measured);

}  // namespace stablecut::dynamics
