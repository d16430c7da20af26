// Joint stiffness from loads and deflections: what can be said of each joint, and how well. README.md,
// "Identification".
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "robot/discrepancy.h"
#include "robot/elastic_models.h"
#include "robot/leave_one_out.h"

namespace stablecut::robot {

struct IdentificationOptions {
  bool huber = false;                                   ///< robust: samples far off count less
  std::array<bool, 3> components = {true, true, true};  ///< of the deflection
  /// Which springs the robot has; none: what predicts blocks of neighbouring poses best.
  std::optional<ElasticModel> model = ElasticModel::kJointsOnly;
};

/// Why a spring has no stiffness in the answer.
enum class Verdict {
  kIdentified,
  kUnseen,       ///< the loads or measurements do not see it
  kInseparable,  ///< seen only together with other springs
  kUncertain,    ///< the 95 % interval of its compliance reaches 0: it may as well be rigid
};

/// How well the samples predict each other.
struct CrossValidation {
  std::optional<double> rms_m;        ///< of deflections less their prediction from the other poses
  std::optional<double> block_rms_m;  ///< from the other blocks of neighbouring poses
  int poses = 0, blocks = 0;
  int samples_not_predicted = 0;  ///< whose pose is alone in what it says of some compliance
};

struct Identification {
  ElasticModel model = ElasticModel::kJointsOnly;
  std::vector<Spring> springs;   ///< of that model, the six joints first
  std::vector<Verdict> verdict;  ///< of each spring
  /// Estimates, rad/(N m) or m/N: 0 where unseen, inseparable, or where the fit holds them at 0.
  Eigen::VectorXd compliance;
  Eigen::MatrixXd covariance;     ///< of the estimates; zero rows where unseen or inseparable
  bool deviations_known = false;  ///< stated by the samples, or estimated from residuals
  std::vector<double> low, high;  ///< 95 % interval of the compliances, NaN without deviations
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
  /// The residuals are more than noise: the deviations come from the scatter between poses.
  bool model_error = false;
  Discrepancy discrepancy;      ///< of deflections at new poses
  double deflection_rms_m = 0;  ///< of the measured components
  ModelChoice models;
  CrossValidation cross_validation;
  std::vector<Outlier> outliers;  ///< farthest first
  /// The samples whose force acts where the deflection is measured moved against their loads on the whole,
  /// which no elastic arm does.
  bool moved_against_loads = false;

  bool identified(int spring) const { return verdict[spring] == Verdict::kIdentified; }
  bool any_identified() const;
};

/// Least squares in the compliances, none below 0. Weights: the samples' deviations; without them all
/// deflections alike, and deflections against rotations by their residuals. Where no joint can be identified,
/// the verdicts say why.
Identification identify_stiffness(const Robot& robot, const std::vector<LoadSample>& samples,
                                  const IdentificationOptions& options);

}  // namespace stablecut::robot
