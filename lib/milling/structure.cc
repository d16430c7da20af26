#include "milling/structure.h"

#include <cmath>
#include <complex>

#include "base/error.h"

namespace stablecut::milling {

Eigen::MatrixXd TipStructure::displacement_of_state() const {
  Eigen::MatrixXd result(directions(), 2 * modes());
  result << 2 * psi_r.real(), -2 * psi_r.imag();
  return result;
}

Eigen::MatrixXd TipStructure::state_rate_of_force() const {
  Eigen::MatrixXd result(2 * modes(), directions());
  result << psi_l.real().transpose(), psi_l.imag().transpose();
  return result;
}

Eigen::MatrixXd TipStructure::free_flight(double time_s) const {
  const Eigen::Index n = modes();
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const std::complex<double> growth = std::exp(lambda[k] * time_s);
    result(k, k) = result(n + k, n + k) = growth.real();
    result(n + k, k) = growth.imag();
    result(k, n + k) = -growth.imag();
  }
  return result;
}

Eigen::MatrixXcd TipStructure::mode_receptances(std::complex<double> s, const Eigen::VectorXcd& force) const {
  Eigen::MatrixXcd moved(directions(), modes());
  for (Eigen::Index k = 0; k < modes(); ++k) {
    moved.col(k) =
        psi_r.col(k) * ((psi_l.col(k).transpose() * force).value() / (s - lambda[k])) +
        psi_r.col(k).conjugate() * ((psi_l.col(k).adjoint() * force).value() / (s - std::conj(lambda[k])));
  }
  return moved;
}

TipStructure tip_structure(const dynamics::ModalModel& model, bool is_axial) {
  TipStructure structure;
  std::vector<Eigen::Index> rows;
  const char* const names[] = {"x", "y", "z"};
  for (Eigen::Index axis = 0; axis < (is_axial ? 3 : 2); ++axis) {
    if (const Eigen::Index row = model.dof(names[axis]); row >= 0) {
      structure.axes.push_back(axis);
      rows.push_back(row);
    }
  }
  if (rows.empty() || structure.axes.front() == 2) throw InvalidArgument("dofs: expected x, y or both");

  std::vector<dynamics::Mode> kept;
  for (std::size_t k = 0; k < model.modes.size(); ++k) {
    dynamics::Mode mode = model.modes[k];
    mode.psi_r = mode.psi_r(rows).eval();
    mode.psi_l = mode.psi_l(rows).eval();
    if (!mode.psi_r.isZero(0) && !mode.psi_l.isZero(0)) {
      kept.push_back(dynamics::normalised(mode));
      structure.source.push_back(k);
    }
  }
  const Eigen::Index n = kept.size();
  structure.lambda.resize(n);
  structure.psi_r.resize(structure.directions(), n);
  structure.psi_l.resize(structure.directions(), n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const dynamics::Mode& mode = kept[k];
    structure.lambda[k] = mode.pole();
    structure.psi_r.col(k) = mode.psi_r;
    structure.psi_l.col(k) = mode.psi_l;
  }
  if (n > 0) structure.displacement_scale_m = structure.psi_r.norm() / std::sqrt(static_cast<double>(n));
  return structure;
}

}  // namespace stablecut::milling
