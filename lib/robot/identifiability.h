// Which joints a set of loads and measurements can see, before any measured value is looked at. README.md,
// "What can be seen".
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "robot/robot.h"

namespace stablecut::robot {

enum class Visibility {
  kVisible,
  kUnseen,       ///< the loads put no torque on the joint, or the measurements do not see its turn
  kInseparable,  ///< its effect is a mixture of other joints' effects
};

/// What equations A c = b, whose rows all have standard deviation 1, say about the unknowns c.
struct Identifiability {
  std::array<Visibility, kJoints> visibility;
  int rank = 0;
  double condition_number = 1;   ///< of the columns that can be told apart, each scaled to length 1
  std::vector<int> independent;  ///< joints whose columns span all that is seen, `rank` of them
};

/// `a` [rows x 6]; `largest` [rows x 6] is the size that each entry would have with the load and the measured
/// direction square to the joint's lever. A joint is unseen when its column is below 1e-3 of that:
/// misalignment gives as much. Columns are dependent below 1e-6 of the largest singular value of the scaled
/// columns.
Identifiability identifiability(const Eigen::MatrixXd& a, const Eigen::MatrixXd& largest);

}  // namespace stablecut::robot
