// How well modes explain weighted curves, with the gradient and matrix that a Gauss-Newton step and the
// Fisher information need [Kay1993] [Pintelon2012]: README.md, "Likelihood".
#pragma once

#include <Eigen/Core>

#include "modal/fit_data.h"
#include "modal/mode_parameters.h"
#include "modal/residual_sums.h"
#include "numerics/levenberg_marquardt.h"

namespace stablecut::modal {

using numerics::NormalEquations;

/// chi-square of modes and its derivatives, as functions of their free parameters. A weak prior, which is
/// part of chi-square, holds modes outside the band near it, damped, and no larger than what is measured:
/// what the curves do not tell of them must not drift.
class Likelihood {
 public:
  /// `out_of_band` [modes]. Both references must outlive this.
  Likelihood(const FitData& data, const ModeParameters& parameters, std::vector<bool> out_of_band);

  /// chi-square, J^T r and J^T J at the parameters x, r being the weighted residual of all curves; without
  /// the matrix also without the gradient. Where the data's poles are fixed their parameters have no
  /// gradient, and in the matrix a 1 on the diagonal alone.
  NormalEquations evaluate(const Eigen::Ref<const Eigen::VectorXd>& x, bool with_matrix) const;

 private:
  void add_priors(const Eigen::Ref<const Eigen::VectorXd>& x, bool with_matrix,
                  NormalEquations& result) const;
  // At the band's nearer end a mode outside it makes a small multiple of what is measured there.
  void add_size_priors(const std::vector<dynamics::Mode>& modes, NormalEquations& coordinates,
                       bool with_matrix) const;
  void hold_poles(const Eigen::Ref<const Eigen::VectorXd>& x, NormalEquations& result) const;

  const FitData& data_;
  const ModeParameters& parameters_;
  ResidualSums residual_;
  std::vector<bool> out_of_band_;
  Eigen::Matrix2Xd sizes_;  // root mean square of each curve's octave at the lower and the upper end, m/N
};

/// Whether each mode lies outside the band of the data.
std::vector<bool> out_of_band(const FitData& data, const std::vector<dynamics::Mode>& modes);

/// Inverse of J^T J by Cholesky, with a ridge that is large enough where J^T J is singular (a mode without
/// residue).
Eigen::MatrixXd inverse_normal_matrix(const NormalEquations& normal);

}  // namespace stablecut::modal
