// How well modes explain weighted curves, with what a Gauss-Newton step and the Fisher information need.
#pragma once

#include <Eigen/Core>

#include "modal/fit_data.h"
#include "modal/mode_parameters.h"
#include "modal/residual_sums.h"

namespace stablecut::modal {

/// With r the weighted residual of all curves and J its Jacobian: chi-square |r|^2, J^T r and J^T J.
struct NormalEquations {
  double chi_square = 0;     ///< sum over lines and curves of |model - h|^2 / variance
  Eigen::VectorXd gradient;  ///< [parameters]
  Eigen::MatrixXd matrix;    ///< [parameters x parameters]
};

/// The modes' likelihood, as a function of their free parameters. Modes outside the band are held near it and
/// damped by a weak prior, which chi-square holds.
class Likelihood {
 public:
  /// `out_of_band` [modes]. Both references must outlive this.
  Likelihood(const FitData& data, const ModeParameters& parameters, std::vector<bool> out_of_band);

  /// Without the matrix also without the gradient.
  NormalEquations evaluate(const Eigen::Ref<const Eigen::VectorXd>& x, bool with_matrix) const;

 private:
  void add_priors(const Eigen::Ref<const Eigen::VectorXd>& x, bool with_matrix,
                  NormalEquations& result) const;

  const FitData& data_;
  const ModeParameters& parameters_;
  ResidualSums residual_;
  std::vector<bool> out_of_band_;
};

/// Whether a mode lies outside the band of the data.
std::vector<bool> out_of_band(const FitData& data, const std::vector<dynamics::Mode>& modes);

/// Inverse of J^T J, by Cholesky; a mode without residue does not stop it.
Eigen::MatrixXd inverse_of(const NormalEquations& normal);
/// U with U^T U = J^T J, as well as that can be factorized.
Eigen::MatrixXd upper_factor(const NormalEquations& normal);

}  // namespace stablecut::modal
