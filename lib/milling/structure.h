// The structure as the stability methods see it: modes that a force at the tool tip drives and that move the
// tip. README.md, "The structure".
#pragma once

#include <Eigen/Core>
#include <complex>
#include <vector>

#include "dynamics/modal_model.h"

namespace stablecut::milling {

/// q' = Lambda q + Psi_L^T f, r = 2 Re(Psi_R q): one complex coordinate for each pair of poles
/// [RobotMillingThesis, eqs. 6-20 and 6-22].
struct TipStructure {
  Eigen::VectorXcd lambda;          ///< [modes], rad/s, positive imaginary parts
  Eigen::MatrixXcd psi_r;           ///< [directions x modes], sqrt(s/kg)
  Eigen::MatrixXcd psi_l;           ///< [directions x modes], sqrt(s/kg)
  std::vector<Eigen::Index> axes;   ///< [directions] 0 for x, 1 for y, 2 for z: those that can move
  std::vector<std::size_t> source;  ///< [modes] index of each in the model
  double displacement_scale_m = 1;  ///< the displacement that a modal coordinate of size 1 causes, about

  Eigen::Index modes() const { return lambda.size(); }
  Eigen::Index directions() const { return axes.size(); }

  /// Tip displacement [directions x 2 modes] of the real state (Re q, Im q), m.
  Eigen::MatrixXd displacement_of_state() const;
  /// Rate of the real state per unit force, [2 modes x directions], 1/(N s).
  Eigen::MatrixXd state_rate_of_force() const;
  /// The map of the real state over `time_s` without a force, [2 modes x 2 modes]; exact.
  Eigen::MatrixXd free_flight(double time_s) const;
  /// The tip's motion in each mode under a force [directions] that grows as exp(s t), s in rad/s: [directions
  /// x modes], m/N times the force's unit. Their sum is the receptance at s times the force.
  Eigen::MatrixXcd mode_receptances(std::complex<double> s, const Eigen::VectorXcd& force) const;
};

/// The modes of a model in its directions x and y, and z where the cut acts along the axis; other dofs are
/// left out, and so are modes that no force in these drives or that move none. Where no mode is left, nothing
/// can chatter. Throws InvalidArgument when the model has neither x nor y.
TipStructure tip_structure(const dynamics::ModalModel& model, bool is_axial = false);

}  // namespace stablecut::milling
