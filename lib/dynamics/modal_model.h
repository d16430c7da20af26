// Non-symmetric complex modes at the tool tip (thesis 6.3, eq. 6-22).
#pragma once

#include <Eigen/Core>
#include <complex>
#include <string>
#include <string_view>
#include <vector>

namespace stablecut::dynamics {

/// One complex mode. Its part of the receptance is psi_r psi_l^T / (i w - lambda) + conjugate pole and
/// vectors.
struct Mode {
  double frequency_hz = 0;   ///< |lambda| / (2 pi)
  double damping_ratio = 0;  ///< -Re(lambda) / |lambda|, in (0, 1)
  Eigen::VectorXcd psi_r;    ///< [dofs] right vector, sqrt(s/kg)
  Eigen::VectorXcd psi_l;    ///< [dofs] left vector, sqrt(s/kg)
  bool out_of_band = false;  ///< stands for what lies outside the measured band

  /// lambda with positive imaginary part, rad/s.
  std::complex<double> pole() const;
  /// psi_r psi_l^T, [dofs x dofs], s/kg: all that can be observed of the vectors.
  Eigen::MatrixXcd residue() const { return psi_r * psi_l.transpose(); }
};

struct ModalModel {
  std::vector<std::string> dofs;  ///< direction names, the rows of psi
  std::vector<Mode> modes;
  /// Of the table's parameters, mode by mode: frequency_hz, damping_ratio, real and imaginary part of each
  /// component of psi_r, then of psi_l. Empty when unknown; zero for what is exact.
  Eigen::MatrixXd covariance;

  /// Row of a direction, or -1.
  Eigen::Index dof(std::string_view name) const;
  Eigen::Index parameters_per_mode() const { return 2 + 4 * static_cast<Eigen::Index>(dofs.size()); }
  /// Standard deviations of one mode's parameters, in the order of the covariance, which must be known.
  Eigen::VectorXd deviation(Eigen::Index mode) const;
};

/// These modes of a model, with their part of its covariance.
ModalModel chosen_modes(const ModalModel& model, const std::vector<std::size_t>& modes);

/// Frequency (Hz) and damping ratio of a pole with positive imaginary part.
void set_pole(Mode& mode, std::complex<double> lambda);

/// The modes without the damping that an exponential window exp(-decay t), decay_per_s, gave them: poles are
/// moved by decay, the covariance with them. Modes outside the band, which stand for other things, keep
/// theirs where they would lose all damping. Throws NoAnswer where a mode in the band would.
ModalModel without_window(ModalModel model, double decay_per_s);

/// The same mode in the contract's scale: |psi_r| = |psi_l|, equal phases at psi_r's largest component (the
/// first of equals), real part there not negative; psi_r = psi_l for a symmetric mode. Where psi_l is zero at
/// that component, psi_r is made real there. A mode without residue is returned as it is.
Mode normalised(Mode mode);

/// Derivatives of the parameters of `normalised(mode)`, in the order of a covariance, by Re lambda, Im
/// lambda, and real and imaginary parts of psi_r, then of psi_l: [2 + 4 dofs square].
Eigen::MatrixXd normalisation_slope(const Mode& mode);

}  // namespace stablecut::dynamics
