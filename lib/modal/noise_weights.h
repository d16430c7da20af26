// How sure each measured value is, and with which weight it therefore counts: README.md, "Weights".
#pragma once

#include <Eigen/Core>
#include <vector>

#include "dynamics/modal_model.h"
#include "modal/fit_data.h"

namespace stablecut::modal {

/// What limits how well modes can follow the curves. It decides how little noise a weight may claim, and what
/// a mode must be worth (mode_selection.h).
enum class Regime {
  kNoise,      ///< the noise of the measurement, given or estimated
  kNoiseless,  ///< the digits of the numbers: computed receptances
  kModelError  ///< what no sum of modes follows; each curve weighs by its size
};

/// Relative error (of a curve's RMS) down to which modes are found where the model, not the noise, is the
/// limit.
inline constexpr double kModelErrorFloor = 0.045;

/// Variance E|error|^2 of the complex values, (m/N)^2: [curves][lines].
using CurveVariances = std::vector<Eigen::VectorXd>;

/// Sets the curves' weights to 1 / (variance + the regime's floors), and what of their errors they share by
/// `shared`, the shared part of the variance (nothing where it is empty, and where the model is the
/// limit).
void weigh_curves(FitData& data, const CurveVariances& variance, const CurveVariances& shared, Regime regime);

/// Whether the floors of the regime, and not the variance, decide more than a percent of all weights.
bool floors_decide(const FitData& data, Regime regime);

/// The noise that the curves show by themselves: what no smooth curve follows.
CurveVariances scatter_of_curves(const FitData& data);
/// The noise that the residual of these modes shows, in the same way.
CurveVariances scatter_of_residual(const FitData& data, const std::vector<dynamics::Mode>& modes);

/// The residual itself taken as noise.
struct ResidualVariances {
  CurveVariances variance;
  bool is_local = false;  ///< some curve's noise follows no smooth shape
};
/// All of the residual of these modes as noise. `correction` is the number of values over the degrees of
/// freedom. Variances follow smooth shapes; with `local_allowed`, the running mean where that is clearly
/// likelier.
ResidualVariances residual_as_noise(const FitData& data, const std::vector<dynamics::Mode>& modes,
                                    double correction, bool local_allowed);

/// Whether some variance has changed so much that the modes must be weighed again.
bool differ_much(const CurveVariances& a, const CurveVariances& b);

}  // namespace stablecut::modal
