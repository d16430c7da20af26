// How a vector of free real numbers describes modes with rank-1 residues, in each of the three models of
// [RobotMillingThesis, 6.3.1]: README.md, "Parameters".
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

/// Two sets of numbers for the same modes.
///
/// The free parameters x, mode by mode: log(-Re lambda / Im lambda) and log(Im lambda), then the vectors. For
/// kNonsymmetric Re and Im of psi_r without its pivot (its largest component, which stays 1) and Re and Im of
/// psi_l; for kSymmetric Re and Im of psi; for kProportional phi / sqrt(2). psi_l, psi and phi are in units
/// of their size at the start, so that all parameters are about 1.
///
/// The coordinates of a table, in which the free complex scale of a mode is not fixed: Re lambda, Im lambda
/// (rad/s), then Re and Im of each component of psi_r, then of psi_l.
class ModeParameters {
 public:
  /// Pivots and units are taken from `modes`, each with `dofs` directions.
  ModeParameters(const std::vector<dynamics::Mode>& modes, Eigen::Index dofs, ModeModel model);

  Eigen::Index modes() const { return pivot_.size(); }
  /// Number of free parameters of all modes, and of one.
  Eigen::Index size() const { return modes() * per_mode(); }
  Eigen::Index per_mode() const { return per_mode(model_, dofs_); }
  static Eigen::Index per_mode(ModeModel model, Eigen::Index dofs);

  /// Places in x of a mode's two logarithms, and of the parameters of its vectors.
  Eigen::Index pole_at(Eigen::Index k) const { return k * per_mode(); }
  Eigen::Index vectors_at(Eigen::Index k) const { return pole_at(k) + 2; }

  /// Of kNonsymmetric: places in x of Re of psi_r's component i, which must not be the pivot, and of psi_l's;
  /// the psi_r component that is held at 1; what psi_l is in units of when that is 1.
  Eigen::Index right_in_x(Eigen::Index k, Eigen::Index i) const { return vectors_at(k) + right_offset(k, i); }
  Eigen::Index left_in_x(Eigen::Index k, Eigen::Index i) const {
    return vectors_at(k) + 2 * (dofs_ - 1) + 2 * i;
  }
  double unit(Eigen::Index k) const { return unit_[k]; }

  /// The parameters of given modes; in a restricted model those of modes near them that are of that model.
  Eigen::VectorXd pack(const std::vector<dynamics::Mode>& modes) const;
  std::vector<dynamics::Mode> unpack(const Eigen::Ref<const Eigen::VectorXd>& x) const;
  std::complex<double> pole(const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::Index k) const;

  /// Number of coordinates of one mode, and the places among them of components of its vectors.
  Eigen::Index coordinates_per_mode() const { return 2 + 4 * dofs_; }
  Eigen::Index right_at(Eigen::Index i) const { return 2 + 2 * i; }
  Eigen::Index left_at(Eigen::Index j) const { return 2 + 2 * dofs_ + 2 * j; }

  /// Jacobian of mode k's coordinates with respect to its parameters [coordinates_per_mode x per_mode].
  Eigen::MatrixXd slope(const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::Index k) const;

  /// The change of mode k's last parameters (psi_l, psi or phi) that makes its residue zero, to first order.
  Eigen::VectorXd removal(const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::Index k) const;

 private:
  // Place of psi_r's component i behind vectors_at(k), for kNonsymmetric; i is not the pivot.
  Eigen::Index right_offset(Eigen::Index k, Eigen::Index i) const;

  Eigen::Index dofs_;
  ModeModel model_;
  std::vector<Eigen::Index> pivot_;
  std::vector<double> unit_;
};

}  // namespace stablecut::modal
