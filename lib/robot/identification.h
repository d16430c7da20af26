// Joint stiffness from loads and deflections (Yi et al., section 3; physics: unknowns 1/k, eqs. 10 and 11).
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "robot/identifiability.h"
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

struct Outlier {
  int sample = 0;
  double residual_m = 0;  ///< length of the residual deflection
  double deviations = 0;  ///< how far it lies from what the other samples predict, in their deviations: RMS
                          ///< of its rows, or its worst row
  double weight = 1;      ///< what the robust loss left of it
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
  std::optional<double> chi_square_per_dof;  ///< where they do
  double chi_square_tail = 1;                ///< its probability, where they do
  /// RMS of each sample's deflection less its prediction from all others, over those that the others can
  /// predict.
  std::optional<double> cross_validation_rms_m;
  int samples_not_predicted = 0;
  /// Samples that lie so far from the prediction of the others that chance does it to one in 16 000; farthest
  /// first.
  std::vector<Outlier> outliers;

  bool identified(int joint) const { return verdict[joint] == JointVerdict::kIdentified; }
};

/// Least squares in the compliances, none below 0. Weights: the samples' deviations; without them all
/// deflections alike, and deflections against rotations by their residuals. Where the samples' deviations are
/// plainly too small (chi-square tail below 1e-3) the covariance is scaled up. Throws NoAnswer when no joint
/// can be identified.
Identification identify_stiffness(const Robot& robot, const std::vector<LoadSample>& samples,
                                  const IdentificationOptions& options);

}  // namespace stablecut::robot
