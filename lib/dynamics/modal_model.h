// Non-symmetric complex modes at the tool tip (thesis 6.3, eq. 6-22).
#pragma once

#include <Eigen/Core>
#include <complex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace stablecut {

/// Standard deviations of a mode's estimates.
struct ModeDeviation {
  double frequency_hz = 0;
  double damping_ratio = 0;
};

/// One complex mode. Its part of the receptance is psi_r psi_l^T / (i w - lambda) + conjugate pole and
/// vectors.
struct Mode {
  double frequency_hz = 0;                 ///< |lambda| / (2 pi)
  double damping_ratio = 0;                ///< -Re(lambda) / |lambda|, in (0, 1)
  Eigen::VectorXcd psi_r;                  ///< [dofs] right vector, sqrt(s/kg)
  Eigen::VectorXcd psi_l;                  ///< [dofs] left vector, sqrt(s/kg)
  bool out_of_band = false;                ///< stands for what lies outside the measured band
  std::optional<ModeDeviation> deviation;  ///< when known

  /// lambda with positive imaginary part, rad/s.
  std::complex<double> pole() const;
  /// psi_r psi_l^T, [dofs x dofs], s/kg: all that can be observed of the vectors.
  Eigen::MatrixXcd residue() const { return psi_r * psi_l.transpose(); }
};

struct ModalModel {
  std::vector<std::string> dofs;  ///< direction names, the rows of psi
  std::vector<Mode> modes;

  /// Row of a direction, or -1.
  Eigen::Index dof(std::string_view name) const;
};

/// Frequency (Hz) and damping ratio of a pole with positive imaginary part.
void set_pole(Mode& mode, std::complex<double> lambda);

/// The same mode in the contract's scale: |psi_r| = |psi_l|, equal phases at psi_r's largest component (the
/// first of equals), real part there not negative; psi_r = psi_l for a symmetric mode. Where psi_l is zero at
/// that component, psi_r is made real there. A mode without residue is returned as it is.
Mode normalised(Mode mode);

}  // namespace stablecut
