// Joint stiffness from loads and deflections: what can be said of each joint, and how well. README.md,
// "Identification".
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "robot/identifiability.h"
#include "robot/leave_one_out.h"
#include "robot/load_sample.h"

namespace stablecut::robot {

struct IdentificationOptions {
  bool huber = false;                                   ///< robust: samples far off count less
  std::array<bool, 3> components = {true, true, true};  ///< of the deflection
};

/// Why a joint has no stiffness in the answer.
enum class JointVerdict {
  kIdentified,
  kUnseen,       ///< the loads or measurements do not see it
  kInseparable,  ///< seen only together with other joints
  kUncertain,    ///< the 95 % interval of its compliance reaches 0: it may as well be rigid
};

struct Identification {
  std::array<JointVerdict, kJoints> verdict;
  JointAngles compliance = JointAngles::Zero();  ///< estimates, rad/(N m); 0 where unseen
  Matrix6d covariance = Matrix6d::Zero();        ///< of the estimates; zero rows where unseen or inseparable
  bool deviations_known = false;                 ///< stated by the samples, or estimated from residuals
  std::array<double, kJoints> low, high;         ///< 95 % interval of the compliances, NaN without deviations
  int rank = 0;
  double condition_number = 1;
  double residual_rms_m = 0;               ///< of the deflection components
  std::optional<double> residual_rms_rad;  ///< of the rotations, when measured
  /// Of the intervals: infinite where the samples state deviations and the residuals agree.
  double degrees_of_freedom = 0;
  std::optional<double> chi_square_per_dof;  ///< where the samples state deviations
  double chi_square_tail = 1;                ///< its probability, there
  /// The stated deviations are plainly too small for the residuals: the covariance was scaled up.
  bool deviations_contradicted = false;
  CrossValidation cross_validation;
  std::vector<Outlier> outliers;  ///< farthest first
  /// The samples whose force acts where the deflection is measured moved against their loads on the whole,
  /// which no elastic arm does.
  bool moved_against_loads = false;

  bool identified(int joint) const { return verdict[joint] == JointVerdict::kIdentified; }
  bool any_identified() const;
};

/// Least squares in the compliances, none below 0. Weights: the samples' deviations; without them all
/// deflections alike, and deflections against rotations by their residuals. Where no joint can be identified,
/// the verdicts say why.
Identification identify_stiffness(const Robot& robot, const std::vector<LoadSample>& samples,
                                  const IdentificationOptions& options);

}  // namespace stablecut::robot
