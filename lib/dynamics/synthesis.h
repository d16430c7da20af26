// Frequency responses of a modal model, with noise when wanted.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <cstdint>
#include <optional>

#include "dynamics/frequency_response.h"
#include "dynamics/modal_model.h"

namespace stablecut::dynamics {

/// Receptance matrix [dofs x dofs], m/N, at the complex frequency s (rad/s; s = i omega on the axis), eq.
/// (6-22).
Eigen::MatrixXcd receptance_at(const ModalModel& model, std::complex<double> s);

/// All entries (response major) of the model's receptance on the given lines.
FrequencyResponse synthesize(const ModalModel& model, const Eigen::VectorXd& frequency_hz);

/// Circular complex Gaussian noise. Standard deviations are of the complex value (both parts together).
struct NoiseLevel {
  std::optional<double> relative_db;  ///< sigma = 10^(-db/20) |H| on each line
  std::optional<double> floor_db;     ///< sigma = 10^(-db/20) RMS(H) of each entry
  std::uint64_t seed = 1;
};

/// Adds noise, and sets each entry's variance to that of the noise. The same seed gives the same noise.
void add_noise(FrequencyResponse& frf, const NoiseLevel& level);

}  // namespace stablecut::dynamics
