// Cutting coefficients from measured mean forces. README.md, "Coefficients from forces".
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "milling/cutter.h"

namespace stablecut::milling {

/// In the order of the fit: Kt, Kr (N/m2) and their edge forces (N/m), Ka and its.
enum class Coefficient { kKt, kKr, kKte, kKre, kKa, kKae };
inline constexpr int kCoefficients = 6;

/// The mean force on the tool in one cut, in its frame: X along the feed, Y normal to it, Z from the tip to
/// the spindle.
struct MeasuredForce {
  Cutter cutter;  ///< teeth, pitches and engagement; its coefficients do not matter
  std::vector<double> runout_m;
  double feed_per_tooth_m = 0;
  double depth_m = 0;
  std::array<std::optional<double>, 3> force_n;
  std::array<std::optional<double>, 3> std_n;
};

enum class CoefficientVerdict {
  kIdentified,
  kHeld,         ///< at a given value
  kUnmeasured,   ///< no force in its directions was measured
  kInseparable,  ///< these cuts see it only together with others
};

/// Of the forces in the plane (0) and along the axis (1).
struct ForceResidual {
  int measured = 0, degrees_of_freedom = 0;
  double rms_n = 0, force_rms_n = 0;
  std::optional<double> chi_square_per_dof;  ///< where deviations are stated
  bool deviations_contradicted = false;      ///< by the residuals: the covariance was scaled up
  bool not_linear = false;                   ///< a force that bends over the feed fits plainly better
  bool uneven = false;                       ///< X and Y scatter plainly differently
};

struct ForceIdentification {
  std::array<CoefficientVerdict, kCoefficients> verdict{};
  Eigen::Matrix<double, kCoefficients, 1> value = Eigen::Matrix<double, kCoefficients, 1>::Zero();
  /// Zero rows where not identified, or where nothing is known of the deviations.
  Eigen::Matrix<double, kCoefficients, kCoefficients> covariance =
      Eigen::Matrix<double, kCoefficients, kCoefficients>::Zero();
  std::array<bool, 2> deviations_known{};
  std::array<double, kCoefficients> half_interval_95{};  ///< 0 where the deviation is not known
  std::array<ForceResidual, 2> residual;

  bool identified(Coefficient c) const {
    return verdict[static_cast<int>(c)] == CoefficientVerdict::kIdentified;
  }
  double of(Coefficient c) const { return value[static_cast<int>(c)]; }
  double std(Coefficient c) const { return std::sqrt(covariance(static_cast<int>(c), static_cast<int>(c))); }
};

/// Least squares by the average force model in general engagement [Altintas2012]. `held`: values of
/// coefficients that are not to be found. Deviations: those stated, else one for the forces in the plane and
/// one for those along the axis, from the residuals. Stated ones have to be there for all forces of a group.
ForceIdentification identify_coefficients(const std::vector<MeasuredForce>& forces,
                                          const std::array<std::optional<double>, kCoefficients>& held = {});

}  // namespace stablecut::milling
