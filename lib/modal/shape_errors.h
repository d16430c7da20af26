// Resonances whose shape no single mode has, and how far their numbers may be off for it: README.md, "Shape
// errors".
#pragma once

#include <Eigen/Core>
#include <vector>

#include "modal/fit_data.h"
#include "modal/likelihood.h"
#include "modal/mode_parameters.h"

namespace stablecut::modal {

/// Changes of all coordinates of the modes (ModeParameters), each of one standard deviation and independent
/// of the others. `x` are the free parameters of `modes`, `normal` the normal equations there.
std::vector<Eigen::VectorXd> shape_errors(const FitData& data, const ModeParameters& parameters,
                                          const Eigen::VectorXd& x, const NormalEquations& normal);

}  // namespace stablecut::modal
