// Frequency responses of a modal model, with noise when wanted.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <cstdint>
#include <optional>

#include "dynamics/frequency_response.h"
#include "dynamics/modal_model.h"

namespace stablecut::dynamics {

/// Receptance matrix [dofs x dofs], m/N, at the complex frequency s (rad/s; i omega for a harmonic force)
/// [RobotMillingThesis, eq. 6-22].
Eigen::MatrixXcd receptance_at(const ModalModel& model, std::complex<double> s);

/// All entries of the model's receptance on the given lines (Hz): xx, xy, ..., yx, yy, ...
FrequencyResponse synthesize(const ModalModel& model, const Eigen::VectorXd& frequency_hz);

/// How large circular complex Gaussian noise is: standard deviations sigma of the complex value, so that each
/// part has sigma / sqrt(2). With both levels their variances add up.
struct NoiseLevel {
  std::optional<double> relative_db;  ///< sigma = 10^(-db/20) |H| on each line
  std::optional<double> floor_db;     ///< sigma = 10^(-db/20) RMS(H) of each entry
  std::uint64_t seed = 1;
};

/// Adds noise to each entry, and sets the entry's variance to that of the noise. The same seed gives the same
/// noise.
void add_noise(FrequencyResponse& frf, const NoiseLevel& level);

}  // namespace stablecut::dynamics
