// Non-symmetric complex modes at the tool tip [RobotMillingThesis, eq. 6-22]: README.md, "Modal model".
#pragma once

#include <Eigen/Core>
#include <complex>
#include <string>
#include <string_view>
#include <vector>

namespace stablecut::dynamics {

/// One complex mode. It adds psi_r psi_l^T / (i omega - lambda) to the receptance, and the same with
/// conjugate pole and vectors.
struct Mode {
  double frequency_hz = 0;   ///< |lambda| / (2 pi)
  double damping_ratio = 0;  ///< -Re(lambda) / |lambda|, in (0, 1)
  Eigen::VectorXcd psi_r;    ///< [dofs] right vector, sqrt(s/kg)
  Eigen::VectorXcd psi_l;    ///< [dofs] left vector, sqrt(s/kg)
  bool out_of_band = false;  ///< carries what modes outside the measured band do inside it

  /// lambda with positive imaginary part, rad/s.
  std::complex<double> pole() const;
  /// psi_r psi_l^T, [dofs x dofs], s/kg: all that can be observed of the vectors.
  Eigen::MatrixXcd residue() const { return psi_r * psi_l.transpose(); }
};

struct ModalModel {
  std::vector<std::string> dofs;  ///< direction names, the rows of psi
  std::vector<Mode> modes;
  /// Covariance of all parameters [modes * parameters_per_mode() square], mode by mode in this order:
  /// frequency_hz, damping_ratio, real and imaginary part of each component of psi_r, then of psi_l. Empty
  /// when unknown; zero for what is exact.
  Eigen::MatrixXd covariance;

  /// Row of a direction, or -1.
  Eigen::Index dof(std::string_view name) const;
  Eigen::Index parameters_per_mode() const { return 2 + 4 * static_cast<Eigen::Index>(dofs.size()); }
  /// Standard deviations of one mode's parameters, in the order of the covariance, which must be known.
  Eigen::VectorXd deviation(Eigen::Index mode) const;
};

/// These modes of a model, with their part of its covariance.
ModalModel chosen_modes(const ModalModel& model, const std::vector<std::size_t>& modes);

/// Modes whose damping ratio, or whose psi_r or psi_l as a whole, is smaller than its own standard deviation:
/// what is said of them tells nothing. Those out of band, which stand for others, are left out. The
/// covariance must be known.
std::vector<std::size_t> untold_modes(const ModalModel& model);

/// Frequency (Hz) and damping ratio of a pole with positive imaginary part.
void set_pole(Mode& mode, std::complex<double> lambda);

/// The modes without the damping that an exponential window exp(-decay_per_s t) added to them [Fladung1997]:
/// every pole moves by decay_per_s to the right, and the covariance follows. Modes marked out of band keep
/// their damping where they would lose all of it; a mode in the band that would throws NoAnswer.
ModalModel without_window(ModalModel model, double decay_per_s);

/// The same mode (the same residue) with its free complex scale fixed as modal tables have it: |psi_r| =
/// |psi_l|, equal phases at psi_r's largest component (the first of equals), real part there not negative. So
/// psi_r = psi_l for a symmetric mode. Where psi_l is zero at that component, psi_r is made real there. A
/// mode without residue is returned as it is.
Mode normalised(Mode mode);

/// Jacobian of the parameters of `normalised(mode)`, in the order of ModalModel::covariance, with respect to
/// Re lambda, Im lambda, and the real and imaginary parts of `mode`'s psi_r, then psi_l: [2 + 4 dofs square].
Eigen::MatrixXd normalisation_slope(const Mode& mode);

}  // namespace stablecut::dynamics
