#include "dynamics/modal_model.h"

#include <algorithm>
#include <cmath>

#include "base/units.h"

namespace stablecut {

std::complex<double> Mode::pole() const {
  const double omega_n = rad_per_s_from_hz(frequency_hz);
  return {-damping_ratio * omega_n, omega_n * std::sqrt(1 - damping_ratio * damping_ratio)};
}

Eigen::Index ModalModel::dof(std::string_view name) const {
  const auto found = std::find(dofs.begin(), dofs.end(), name);
  return found == dofs.end() ? -1 : found - dofs.begin();
}

void set_pole(Mode& mode, std::complex<double> lambda) {
  mode.frequency_hz = hz_from_rad_per_s(std::abs(lambda));
  mode.damping_ratio = -lambda.real() / std::abs(lambda);
}

Mode normalised(Mode mode) {
  const double norm_r = mode.psi_r.norm();
  const double norm_l = mode.psi_l.norm();
  if (norm_r == 0 || norm_l == 0) return mode;
  Eigen::Index largest = 0;
  for (Eigen::Index i = 1; i < mode.psi_r.size(); ++i) {
    if (std::abs(mode.psi_r[i]) > std::abs(mode.psi_r[largest])) largest = i;
  }
  const std::complex<double> product = mode.psi_r[largest] * mode.psi_l[largest];
  // psi_r takes the factor c, psi_l its inverse; the shared phase is half of the product's, in (-90, 90].
  const double wanted_phase = std::abs(product) > 0 ? std::arg(product) / 2 : 0.0;
  const std::complex<double> factor =
      std::polar(std::sqrt(norm_l / norm_r), wanted_phase - std::arg(mode.psi_r[largest]));
  mode.psi_r *= factor;
  mode.psi_l /= factor;
  return mode;
}

}  // namespace stablecut
