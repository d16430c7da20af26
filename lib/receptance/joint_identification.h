// The joint between tool and holder from a measured tip receptance: the problem of [Liu2014, section 2], by
// least squares with a scan of starts in place of a genetic algorithm. README.md, sections 11 to 14.
#pragma once

#include <array>
#include <vector>

#include "receptance/held_tool.h"

namespace stablecut::receptance {

/// k1, c1, k2, c2 in the order of ToolJoint, in its units.
using JointValues = std::array<double, 4>;
JointValues values_of(const ToolJoint& joint);
ToolJoint joint_of(const JointValues& values);

/// The range that bounds must keep to, in the order of JointValues.
inline constexpr JointValues kLeastBound = {1e-20, 0, 1e-20, 0};
inline constexpr double kLargestBound = 1e20;

/// Each bound below its counterpart.
struct JointBounds {
  JointValues least = {1e3, 0, 1e-1, 0};
  JointValues most = {1e12, 1e7, 1e10, 1e6};
};

/// Fewer lines identify nothing.
inline constexpr Eigen::Index kLeastJointLines = 4;

enum class JointObjective {
  kComplex,    ///< sum of |H - H_measured|^2 / variance: maximum likelihood [Kay1993]
  kAmplitude,  ///< sum of (|H| - |H_measured|)^2, without weights [Liu2014, section 2.2]
};

/// One direction's measured tip, and tool and holder cut at the joint, line by line.
struct JointData {
  Eigen::VectorXd omega_rad_per_s;   ///< [lines]
  std::vector<JointPlane<2>> plane;  ///< [lines]
  Eigen::VectorXcd tip;              ///< [lines] measured, displacement per force, m/N
  /// [lines] of the complex value, both parts together; empty: unknown. A variance far below those of the
  /// lines around it is raised.
  Eigen::VectorXd variance;
};

struct JointEstimate {
  ToolJoint joint;
  JointValues deviation{};  ///< standard deviations; 0 for values at a bound
  /// The standard deviation is at most 30 % of the value, also if the value were the lower end of its 95 %
  /// interval. Never of a value at its bound.
  std::array<bool, 4> identifiable{};
  std::array<bool, 4> at_bound{};
  double residual = 0;   ///< |H - H_measured| / |H_measured|, norms over the lines
  double objective = 0;  ///< square root of the objective's sum, without weights, m/N
};

/// The best joint within the bounds; no start is needed. An unknown noise is taken as equal on all lines, or
/// as a share of the value where that makes the residual white and likelier. Residuals that are correlated
/// over lines, as those of a wrong model, widen the deviations. Throws InvalidArgument for bounds that are
/// not increasing or beyond kLeastBound and kLargestBound and for fewer than kLeastJointLines lines, NoAnswer
/// for a tip that does not move and where no joint gives a finite receptance.
JointEstimate identify_joint(const JointData& data, const JointBounds& bounds, JointObjective objective);

/// What whoever uses an estimate should know.
struct JointFinding {
  enum class Kind {
    kUnexplained,      ///< no joint explains the tip; `number`: the estimate's residual
    kNothingTold,      ///< no value is identifiable, and none lies at a bound that was chosen
    kPoorFit,          ///< `number`: the residual
    kAtBound,          ///< `value` lies at its bound, `number`
    kNotIdentifiable,  ///< `value`; `number`: its standard deviation over it
  };
  Kind kind;
  std::size_t value = 0;  ///< index of JointValues
  double number = 0;
};

/// In the order of the kinds, but value by value. Amplitudes are never unexplained: their phase is free.
/// Values at a bound that is narrower than JointBounds{} are what was asked for, not what nothing is known
/// of.
std::vector<JointFinding> findings_of(const JointEstimate& estimate, const JointBounds& bounds,
                                      JointObjective objective);

}  // namespace stablecut::receptance
