// A loaded and measured pose, and what it says about the joints' compliances.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "robot/kinematics.h"

namespace stablecut::robot {

/// Forces, moments and measurements in the base frame; points in the flange frame, m.
struct LoadSample {
  JointAngles angles;
  Eigen::Vector3d force_n = Eigen::Vector3d::Zero();
  Eigen::Vector3d moment_n_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d force_point;      ///< where the force acts
  Eigen::Vector3d measuring_point;  ///< whose displacement is measured
  Eigen::Vector3d deflection_m = Eigen::Vector3d::Zero();
  std::optional<Eigen::Vector3d> rotation_rad;  ///< of the last link, when measured
  std::optional<Eigen::Vector3d> deflection_std_m, rotation_std_rad;
};

/// The measured components and their samples: A c = b with the joint compliances c (rad/(N m)). Column j of A
/// is J_j (J_j . load), the movement of what is measured per unit of compliance of joint j [Yi2025, eqs. 10
/// and 11].
struct ComplianceEquations {
  Eigen::MatrixXd a;           ///< [rows x 6], m N m or rad N m
  Eigen::VectorXd b;           ///< [rows], m or rad
  Eigen::VectorXd std;         ///< [rows], m or rad; empty when the samples state none
  std::vector<int> sample;     ///< [rows] index of the row's sample; rows of a sample are neighbours
  std::vector<bool> rotation;  ///< [rows] the row is a rotation, else a deflection
  Eigen::MatrixXd largest;     ///< [rows x 6] size that a would have with the load and the measured direction
                               ///< square to the joint's lever
};

/// A row for each of the deflection's `components` (x, y, z) and for all three of a measured rotation. Either
/// all samples state standard deviations or none.
ComplianceEquations compliance_equations(const Robot& robot, const std::vector<LoadSample>& samples,
                                         const std::array<bool, 3>& components);

/// Length of the largest measured deflection, m.
double largest_deflection(const std::vector<LoadSample>& samples);

/// False for a largest deflection, m, that no robot shows under a test load: most often a wrong unit. None at
/// all (0) is plausible.
bool plausible_deflection(double largest_m);

}  // namespace stablecut::robot
