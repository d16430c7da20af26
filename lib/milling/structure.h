// The structure as the stability methods see it: modes driven at and read off the tool tip.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <vector>

#include "dynamics/modal_model.h"

namespace stablecut::milling {

/// q' = Lambda q + Psi_L^T f, r = 2 Re(Psi_R q): one complex state for each pair of poles (6-20), (6-22).
struct TipStructure {
  Eigen::VectorXcd lambda;          ///< [modes], rad/s, positive imaginary parts
  Eigen::MatrixXcd psi_r;           ///< [directions x modes], sqrt(s/kg)
  Eigen::MatrixXcd psi_l;           ///< [directions x modes], sqrt(s/kg)
  std::vector<Eigen::Index> axes;   ///< [directions] 0 for x, 1 for y: which directions can move
  std::vector<std::size_t> source;  ///< [modes] index of each in the model
  double displacement_scale_m = 1;  ///< a displacement of this size is comparable to a state of size 1

  Eigen::Index modes() const { return lambda.size(); }
  Eigen::Index directions() const { return axes.size(); }

  /// Tip displacement [directions x 2 modes] of the real state (Re q, Im q), m.
  Eigen::MatrixXd displacement_of_state() const;
  /// Rate of the real state per unit force, [2 modes x directions], 1/(N s).
  Eigen::MatrixXd state_rate_of_force() const;
  /// The real state's map over free flight of `time_s`, [2 modes x 2 modes]: exact.
  Eigen::MatrixXd free_flight(double time_s) const;
  /// How each mode moves the tip under a force [directions] at the complex frequency s (rad/s), [directions x
  /// modes], m/N times the force; their sum is the receptance times the force.
  Eigen::MatrixXcd mode_receptances(std::complex<double> s, const Eigen::VectorXcd& force) const;
};

/// Directions x and y of the model. Other dofs are left out, and so is a mode that no force in x or y drives
/// or that moves neither: the result may have no modes, and then nothing can chatter. Throws InvalidArgument
/// when the model has neither direction.
TipStructure tip_structure(const dynamics::ModalModel& model);

}  // namespace stablecut::milling
