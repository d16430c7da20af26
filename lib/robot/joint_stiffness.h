// The stiffness of a robot as far as it is known: of its joints and, in richer models, of its base and
// bearings; and how far what follows from it is off.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "robot/discrepancy.h"
#include "robot/springs.h"

namespace stablecut::robot {

/// What yields: springs, the six joints' first, and the compliance of each, rad/(N m), m/N for the base.
struct Elasticity {
  std::vector<Spring> springs;
  Eigen::VectorXd compliance;
};

/// The joints alone, rad/(N m).
Elasticity joints_only(const JointAngles& compliance);

/// How far deflections that an Elasticity predicts are off.
struct ElasticityErrors {
  std::optional<Eigen::MatrixXd> covariance;  ///< of the compliances; zero rows where nothing is known
  Discrepancy discrepancy;                    ///< beside it

  bool known() const { return covariance || !discrepancy.none(); }
};

/// What a document says.
struct JointStiffness {
  std::array<std::optional<double>, kJoints> stiffness;  ///< N m/rad
  std::array<std::optional<double>, kJoints> least;      ///< N m/rad: a bound where no stiffness is known
  std::vector<Spring> others;                            ///< springs after the joints
  std::vector<std::optional<double>> other_compliance;   ///< rad/(N m), m/N for the base
  ElasticityErrors errors;                               ///< covariance of the joints, then of the others
};

}  // namespace stablecut::robot
