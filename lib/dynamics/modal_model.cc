#include "dynamics/modal_model.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/error.h"
#include "base/number_text.h"
#include "base/units.h"

namespace stablecut::dynamics {

std::complex<double> Mode::pole() const {
  const double omega_n = rad_per_s_from_hz(frequency_hz);
  return {-damping_ratio * omega_n, omega_n * std::sqrt(1 - damping_ratio * damping_ratio)};
}

Eigen::Index ModalModel::dof(std::string_view name) const {
  const auto found = std::find(dofs.begin(), dofs.end(), name);
  return found == dofs.end() ? -1 : found - dofs.begin();
}

Eigen::VectorXd ModalModel::deviation(Eigen::Index mode) const {
  return covariance.diagonal().segment(mode * parameters_per_mode(), parameters_per_mode()).cwiseSqrt();
}

ModalModel chosen_modes(const ModalModel& model, const std::vector<std::size_t>& modes) {
  ModalModel chosen;
  chosen.dofs = model.dofs;
  std::vector<Eigen::Index> rows;
  for (const std::size_t k : modes) {
    chosen.modes.push_back(model.modes[k]);
    for (Eigen::Index p = 0; p < model.parameters_per_mode(); ++p)
      rows.push_back(static_cast<Eigen::Index>(k) * model.parameters_per_mode() + p);
  }
  if (model.covariance.size() > 0) chosen.covariance = model.covariance(rows, rows);
  return chosen;
}

std::vector<std::size_t> untold_modes(const ModalModel& model) {
  const auto vector = 2 * static_cast<Eigen::Index>(model.dofs.size());  // real and imaginary parts
  std::vector<std::size_t> untold;
  for (std::size_t k = 0; k < model.modes.size(); ++k) {
    const Mode& mode = model.modes[k];
    const Eigen::VectorXd deviation = model.deviation(static_cast<Eigen::Index>(k));
    if (!mode.out_of_band &&
        (deviation[1] > mode.damping_ratio || deviation.segment(2, vector).norm() > mode.psi_r.norm() ||
         deviation.tail(vector).norm() > mode.psi_l.norm()))
      untold.push_back(k);
  }
  return untold;
}

void set_pole(Mode& mode, std::complex<double> lambda) {
  mode.frequency_hz = hz_from_rad_per_s(std::abs(lambda));
  mode.damping_ratio = -lambda.real() / std::abs(lambda);
}

ModalModel without_window(ModalModel model, double decay_per_s) {
  const Eigen::Index own = model.parameters_per_mode();
  for (std::size_t k = 0; k < model.modes.size(); ++k) {
    Mode& mode = model.modes[k];
    const double omega = rad_per_s_from_hz(mode.frequency_hz), zeta = mode.damping_ratio;
    if (zeta * omega <= decay_per_s) {
      if (mode.out_of_band) continue;
      throw NoAnswer("the mode at " + number_text(mode.frequency_hz) + " Hz decays by " +
                     number_text(zeta * omega) + " 1/s, less than the window alone");
    }
    set_pole(mode, mode.pole() + decay_per_s);
    if (model.covariance.size() == 0) continue;
    // omega'^2 = omega^2 - 2 decay zeta omega + decay^2, zeta' omega' = zeta omega - decay.
    const double moved = rad_per_s_from_hz(mode.frequency_hz);
    Eigen::Matrix2d slope;
    slope(0, 0) = (omega - decay_per_s * zeta) / moved;
    slope(0, 1) = -decay_per_s * omega / moved / kTwoPi;
    slope(1, 0) = kTwoPi * (zeta - mode.damping_ratio * slope(0, 0)) / moved;
    slope(1, 1) = (omega - mode.damping_ratio * slope(0, 1) * kTwoPi) / moved;
    const Eigen::Index at = static_cast<Eigen::Index>(k) * own;
    model.covariance.middleRows(at, 2) = (slope * model.covariance.middleRows(at, 2)).eval();
    model.covariance.middleCols(at, 2) = (model.covariance.middleCols(at, 2) * slope.transpose()).eval();
  }
  return model;
}

namespace {

// The first of the largest components of psi_r, where the phases are made equal.
Eigen::Index reference_component(const Mode& mode) {
  Eigen::Index largest = 0;
  for (Eigen::Index i = 1; i < mode.psi_r.size(); ++i) {
    if (std::abs(mode.psi_r[i]) > std::abs(mode.psi_r[largest])) largest = i;
  }
  return largest;
}

// normalised() multiplies psi_r by this factor and divides psi_l by it. At the reference component both then
// have half the phase of their product, in (-90, 90] degrees.
std::complex<double> normalising_factor(const Mode& mode) {
  const Eigen::Index at = reference_component(mode);
  // A symmetric mode stays exactly so.
  if (mode.psi_r == mode.psi_l) return mode.psi_r[at].real() < 0 ? -1 : 1;
  const std::complex<double> product = mode.psi_r[at] * mode.psi_l[at];
  const double wanted_phase = std::abs(product) > 0 ? std::arg(product) / 2 : 0.0;
  return std::polar(std::sqrt(mode.psi_l.norm() / mode.psi_r.norm()),
                    wanted_phase - std::arg(mode.psi_r[at]));
}

bool has_residue(const Mode& mode) { return mode.psi_r.norm() > 0 && mode.psi_l.norm() > 0; }

}  // namespace

Mode normalised(Mode mode) {
  if (!has_residue(mode)) return mode;
  const std::complex<double> factor = normalising_factor(mode);
  mode.psi_r *= factor;
  mode.psi_l /= factor;
  return mode;
}

Eigen::MatrixXd normalisation_slope(const Mode& mode) {
  using Complex = std::complex<double>;
  const Eigen::Index dofs = mode.psi_r.size(), size = 2 + 4 * dofs;
  Eigen::MatrixXd slope = Eigen::MatrixXd::Zero(size, size);
  const Complex lambda = mode.pole();
  const double omega_n = std::abs(lambda);
  slope.row(0).head(2) << hz_from_rad_per_s(lambda.real() / omega_n),
      hz_from_rad_per_s(lambda.imag() / omega_n);
  slope.row(1).head(2) << -std::pow(lambda.imag(), 2), lambda.real() * lambda.imag();
  slope.row(1) /= std::pow(omega_n, 3);
  if (!has_residue(mode)) {
    slope.bottomRightCorner(4 * dofs, 4 * dofs).setIdentity();
    return slope;
  }
  const Complex factor = normalising_factor(mode);
  const Eigen::Index at = reference_component(mode);
  const Eigen::VectorXcd right = mode.psi_r * factor, left = mode.psi_l / factor;
  for (Eigen::Index column = 2; column < size; ++column) {
    // Derivatives of the vectors with respect to this coordinate, then that of the factor's logarithm.
    Eigen::VectorXcd change = Eigen::VectorXcd::Zero(2 * dofs);
    change[(column - 2) / 2] = column % 2 == 0 ? Complex(1, 0) : Complex(0, 1);
    const Eigen::VectorXcd of_right = change.head(dofs), of_left = change.tail(dofs);
    const double turn_right = (of_right[at] / mode.psi_r[at]).imag();
    const double turn =
        mode.psi_l[at] == 0.0 ? -turn_right : ((of_left[at] / mode.psi_l[at]).imag() - turn_right) / 2;
    const Complex of_log((mode.psi_l.dot(of_left).real() / mode.psi_l.squaredNorm() -
                          mode.psi_r.dot(of_right).real() / mode.psi_r.squaredNorm()) /
                             2,
                         turn);
    Eigen::VectorXcd result(2 * dofs);
    result << factor * of_right + right * of_log, of_left / factor - left * of_log;
    for (Eigen::Index i = 0; i < 2 * dofs; ++i) {
      slope(2 + 2 * i, column) = result[i].real();
      slope(3 + 2 * i, column) = result[i].imag();
    }
  }
  return slope;
}

}  // namespace stablecut::dynamics
