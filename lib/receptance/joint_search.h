// The joint that fits best within bounds. README.md, section 13.
#pragma once

#include "receptance/joint_starts.h"

namespace stablecut::receptance {

/// The best joint that Levenberg-Marquardt [Levenberg1944] [Marquardt1963], by [Ceres], reaches from a start;
/// at most `most_steps` steps for each set of values that are held at their bounds.
JointCandidate refined_joint(const TipLines& lines, const ToolJoint& start, const JointBounds& bounds,
                             JointObjective objective, int most_steps);

/// The same from where another search ended, with all the steps that it may take.
JointCandidate converged_joint(const TipLines& lines, const ToolJoint& start, const JointBounds& bounds,
                               JointObjective objective);

/// The best joint from all starts.
JointCandidate best_joint(const TipLines& lines, const JointBounds& bounds, JointObjective objective);

/// Derivatives of a line's weighted residual (its real and its imaginary part) by k1, c1, k2 and c2.
Eigen::Matrix<double, 2, 4> residual_derivatives(const TipLine& line, const Tip& tip,
                                                 JointObjective objective);

}  // namespace stablecut::receptance
