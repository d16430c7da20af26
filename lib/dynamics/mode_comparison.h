// Two modal tables side by side: README.md, "Comparing tables".
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "dynamics/modal_model.h"

namespace stablecut::dynamics {

/// |a^H b|^2 / (|a|^2 |b|^2), the modal assurance criterion [Allemang1982]: 1 for vectors that differ by a
/// complex factor, 0 for orthogonal ones and for zeros.
double modal_assurance(const Eigen::VectorXcd& a, const Eigen::VectorXcd& b);

/// |psi^T psi|^2 / |psi|^4, the modal phase collinearity [Juang1985] about zero: 1 where all components have
/// one phase or its opposite, as those of a real mode, 0 for a circle (a travelling wave). Of a vector that
/// is not zero.
double phase_collinearity(const Eigen::VectorXcd& psi);

/// Minor over major axis of the ellipse that the vector's components draw in the complex plane, which is
/// sqrt((1 - c) / (1 + c)) with c the root of phase_collinearity: 0 for a real mode, 1 for a travelling wave.
double complexity(const Eigen::VectorXcd& psi);

/// The same mode in two tables.
struct ModePair {
  std::size_t first = 0, second = 0;           ///< index in each table
  double assurance = 0;                        ///< of psi_r in the shared directions
  double frequency_hz = 0, damping_ratio = 0;  ///< second less first
  /// Deviations of the two differences, where the tables have some; errors of the two are independent.
  std::optional<double> frequency_std_hz, damping_std;
};

struct ModeComparison {
  std::vector<std::string> dofs;                       ///< directions that both tables have
  std::vector<std::size_t> first, second;              ///< the modes that are compared: those in the band
  Eigen::MatrixXd assurance;                           ///< [first x second] of psi_r in these directions
  std::vector<ModePair> pairs;                         ///< by the first table
  std::vector<std::size_t> first_alone, second_alone;  ///< modes in the band without a partner
};

/// Pairs the modes whose ringing has most in common. Throws InvalidArgument where the tables have no
/// direction in common.
ModeComparison compare_modes(const ModalModel& first, const ModalModel& second);

}  // namespace stablecut::dynamics
