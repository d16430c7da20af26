// How a vector of free real numbers describes rank-1 modes, in each of the thesis' three models (6.3.1).
#pragma once

#include <Eigen/Core>
#include <complex>
#include <vector>

#include "dynamics/modal_model.h"

namespace stablecut::modal {

/// What is assumed of the residue of a mode.
enum class ModeModel {
  kNonsymmetric,  ///< psi_r psi_l^T, both complex (6-22)
  kSymmetric,     ///< psi psi^T, complex (6-19)
  kProportional   ///< phi phi^T / (2 i Im lambda), phi real and normalised to unit mass (6-13)
};

/// Two sets of coordinates. The free parameters x, all modes in turn: log(-Re lambda / Im lambda), log(Im
/// lambda), then for kNonsymmetric Re and Im of psi_r without its pivot (which stays 1) and of psi_l; for
/// kSymmetric of psi; for kProportional phi / sqrt(2); psi_l, psi and phi in units of their size at the
/// start, so that all parameters are about 1. And the coordinates of a table, with the free scale of a mode
/// among them: Re lambda, Im lambda, then Re and Im of each component of psi_r, then of psi_l.
class ModeParameters {
 public:
  /// For modes like these (pivots and units are theirs), each with `dofs` directions.
  ModeParameters(const std::vector<dynamics::Mode>& modes, Eigen::Index dofs, ModeModel model);

  Eigen::Index modes() const { return pivot_.size(); }
  /// Free parameters, and those of one mode.
  Eigen::Index size() const { return modes() * per_mode(); }
  Eigen::Index per_mode() const { return per_mode(model_, dofs_); }
  static Eigen::Index per_mode(ModeModel model, Eigen::Index dofs);

  /// Where the logarithms of a mode's pole stand in x, and the parameters of its vectors.
  Eigen::Index pole_at(Eigen::Index k) const { return k * per_mode(); }
  Eigen::Index vectors_at(Eigen::Index k) const { return pole_at(k) + 2; }

  /// The parameters of given modes; for the restricted models of the nearest such ones.
  Eigen::VectorXd pack(const std::vector<dynamics::Mode>& modes) const;
  std::vector<dynamics::Mode> unpack(const Eigen::Ref<const Eigen::VectorXd>& x) const;
  std::complex<double> pole(const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::Index k) const;

  /// Coordinates of one mode, and where they stand among its coordinates.
  Eigen::Index coordinates_per_mode() const { return 2 + 4 * dofs_; }
  Eigen::Index right_at(Eigen::Index i) const { return 2 + 2 * i; }
  Eigen::Index left_at(Eigen::Index j) const { return 2 + 2 * dofs_ + 2 * j; }

  /// Derivatives of mode k's coordinates by its parameters [coordinates_per_mode x per_mode].
  Eigen::MatrixXd slope(const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::Index k) const;

  /// The change of mode k's last parameters (psi_l, psi or phi) that takes its residue away, to first order.
  Eigen::VectorXd removal(const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::Index k) const;

 private:
  // Of kNonsymmetric, from vectors_at on.
  Eigen::Index right_offset(Eigen::Index k, Eigen::Index i) const;

  Eigen::Index dofs_;
  ModeModel model_;
  std::vector<Eigen::Index> pivot_;
  std::vector<double> unit_;
};

}  // namespace stablecut::modal
