// A loaded and measured pose, and what it says about the joints' compliances.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "robot/springs.h"

namespace stablecut::robot {

/// Forces, moments and measurements in the base frame; points in the flange frame, m.
struct LoadSample {
  JointAngles angles;
  Eigen::Vector3d force_n = Eigen::Vector3d::Zero();
  Eigen::Vector3d moment_n_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d force_point;      ///< where the force acts
  Eigen::Vector3d measuring_point;  ///< whose displacement is measured
  Eigen::Vector3d deflection_m = Eigen::Vector3d::Zero();
  /// The deflection is from where the robot would be without weight, so that its links' weight is a load too.
  /// Between an unloaded and a loaded robot their weight makes no difference.
  bool with_own_weight = false;
  std::optional<Eigen::Vector3d> rotation_rad;  ///< of the last link, when measured
  std::optional<Eigen::Vector3d> deflection_std_m, rotation_std_rad;
};

/// The measured components and their samples: A c = b with the springs' compliances c. Column k of A is the
/// movement of what is measured per unit of compliance of spring k: its displacement or rotation per unit
/// times its load [Yi2025, eqs. 10 and 11].
struct ComplianceEquations {
  std::vector<Spring> springs;  ///< of the columns, the six joints first
  Eigen::MatrixXd a;            ///< [rows x springs], m N m or rad N m; m N or rad N for the base
  Eigen::VectorXd b;            ///< [rows], m or rad
  Eigen::VectorXd std;          ///< [rows], m or rad; empty when the samples state none
  std::vector<int> sample;      ///< [rows] index of the row's sample; rows of a sample are neighbours
  std::vector<bool> rotation;   ///< [rows] the row is a rotation, else a deflection
  Eigen::MatrixXd largest;      ///< [rows x springs] size that a would have with the load and the measured
                                ///< direction square to the spring's lever
};

/// A row for each of the deflection's `components` (x, y, z) and for all three of a measured rotation. Either
/// all samples state standard deviations or none.
ComplianceEquations compliance_equations(const Robot& robot, const std::vector<Spring>& springs,
                                         const std::vector<LoadSample>& samples,
                                         const std::array<bool, 3>& components);

/// The same with some of the springs only, which are among those of `equations` in the same order.
ComplianceEquations with_springs(const ComplianceEquations& equations, const std::vector<Spring>& springs);

/// Length of the largest measured deflection, m.
double largest_deflection(const std::vector<LoadSample>& samples);

/// False for a largest deflection, m, that no robot shows under a test load: most often a wrong unit. None at
/// all (0) is plausible.
bool plausible_deflection(double largest_m);

}  // namespace stablecut::robot
