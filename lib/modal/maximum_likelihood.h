// Joint maximum-likelihood refinement of rank-1 non-symmetric modes (thesis 6.3.2, weighted by the noise).
#pragma once

#include <vector>

#include "dynamics/modal_model.h"
#include "modal/fit_data.h"
#include "modal/mode_parameters.h"

namespace stablecut::modal {

/// When a refinement ends.
struct Effort {
  int iterations = 100;
  double tolerance = 1e-5;  ///< change of chi_square, which is 1 for each value where only noise is left
};

struct RefinedModes {
  std::vector<dynamics::Mode> modes;
  double chi_square = 0;  ///< sum over lines and curves of |model - h|^2 / variance
  bool converged = false;
  /// Loss in chi-square, to second order, when the mode's residue is taken away and all else adapts: [modes].
  Eigen::VectorXd removal_loss;
};

/// Minimises the weighted squared error of all curves at once over poles and vectors, from the given modes.
/// Modes that start outside the band are held near it by a weak prior, which chi_square holds.
/// Levenberg-Marquardt with analytic derivatives, until a step changes chi_square by less than the tolerance.
RefinedModes refine_modes(const FitData& data, const std::vector<dynamics::Mode>& start, ModeModel model,
                          const Effort& effort);

/// The model on the data's lines for one curve.
Eigen::VectorXcd curve_of(const std::vector<dynamics::Mode>& modes, const Curve& curve,
                          const Eigen::VectorXcd& s);

/// Sum over lines and curves of |model - h|^2 / variance.
double chi_square_of(const FitData& data, const std::vector<dynamics::Mode>& modes);

}  // namespace stablecut::modal
