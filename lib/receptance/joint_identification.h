// The joint between tool and holder from a measured tip receptance (Liu et al., section 2, by least squares
// in place of the genetic algorithm).
#pragma once

#include <array>
#include <vector>

#include "receptance/held_tool.h"

namespace stablecut::receptance {

/// k1, c1, k2, c2 in the order of ToolJoint, in its units.
using JointValues = std::array<double, 4>;
JointValues values_of(const ToolJoint& joint);
ToolJoint joint_of(const JointValues& values);

/// What bounds may be, in the order of JointValues.
inline constexpr JointValues kLeastBound = {1e-20, 0, 1e-20, 0};
inline constexpr double kLargestBound = 1e20;

/// Increasing.
struct JointBounds {
  JointValues least = {1e3, 0, 1e-1, 0};
  JointValues most = {1e12, 1e7, 1e10, 1e6};
};

/// Lines without which nothing is identified.
inline constexpr Eigen::Index kLeastJointLines = 4;

enum class JointObjective {
  kComplex,    ///< sum of |H - H_measured|^2, weighted by the noise: maximum likelihood
  kAmplitude,  ///< sum of (|H| - |H_measured|)^2, the paper's
};

/// The tip as it was measured and as tool and holder would make it, line by line, in one direction.
struct JointData {
  Eigen::VectorXd omega_rad_per_s;   ///< [lines]
  std::vector<JointPlane<2>> plane;  ///< [lines]
  Eigen::VectorXcd tip;              ///< [lines] measured, displacement per force, m/N
  Eigen::VectorXd variance;  ///< [lines] of the complex value, both parts together; empty: unknown. A line
                             ///< far surer than those around it is not believed
};

struct JointEstimate {
  ToolJoint joint;
  JointValues deviation{};  ///< standard deviations; of values at a bound 0
  /// The standard deviation is at most 30 % of the value, and would be so of the lower end of the value's 95
  /// % interval. A value at its bound never is.
  std::array<bool, 4> identifiable{};
  std::array<bool, 4> at_bound{};
  double residual = 0;   ///< |H - H_measured| / |H_measured|, norms over the lines
  double objective = 0;  ///< the square root of the objective's sum without weights, m/N
};

/// The best joint within the bounds, whatever the start: the curve is linear in one stiffness when the other
/// is given, so the other is scanned and every good pair refined.
///
/// An unknown noise is taken as the same on all lines, or as a share of the value where the residual says so.
/// Residuals that hang together over lines (a model that does not fit) widen the deviations. Throws
/// InvalidArgument for bounds that are not increasing or beyond kLeastBound and kLargestBound, and for fewer
/// than kLeastJointLines lines, NoAnswer where no joint can be found.
JointEstimate identify_joint(const JointData& data, const JointBounds& bounds, JointObjective objective);

}  // namespace stablecut::receptance
