// All modes refined together by maximum likelihood ([RobotMillingThesis, 6.3.2], weighted by the noise):
// README.md, "Refinement".
#pragma once

#include <vector>

#include "dynamics/modal_model.h"
#include "modal/fit_data.h"
#include "modal/mode_parameters.h"

namespace stablecut::modal {

/// When a refinement ends.
struct Effort {
  int iterations = 100;
  /// A step that changes chi_square by less ends it; by chi_square over the number of values more where it is
  /// larger.
  double tolerance = 1e-5;
};

struct RefinedModes {
  std::vector<dynamics::Mode> modes;
  double chi_square = 0;  ///< sum over lines and curves of |model - h|^2 / variance
  bool converged = false;
  /// By how much chi-square grows, to second order, when a mode is taken away and all others adapt: [modes].
  Eigen::VectorXd removal_loss;
};

/// Minimises the weighted squared error of all curves at once over poles and vectors, from the given modes,
/// by Levenberg-Marquardt [Levenberg1944] [Marquardt1963], until a step changes chi_square by less
/// than the tolerance. A weak prior, which is part of chi_square, holds modes that start outside the band
/// near it. Without modes chi_square is that of the curves alone.
RefinedModes refine_modes(const FitData& data, const std::vector<dynamics::Mode>& start, ModeModel model,
                          const Effort& effort);

/// The model on the data's lines for one curve.
Eigen::VectorXcd curve_of(const std::vector<dynamics::Mode>& modes, const Curve& curve,
                          const Eigen::VectorXcd& s);

/// Sum over lines and curves of |model - h|^2 / variance.
double chi_square_of(const FitData& data, const std::vector<dynamics::Mode>& modes);

}  // namespace stablecut::modal
