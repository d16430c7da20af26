// Which springs a set of loads and measurements can see, before any measured value is looked at. README.md,
// "What can be seen".
#pragma once

#include <Eigen/Core>
#include <vector>

namespace stablecut::robot {

enum class Visibility {
  kVisible,
  kUnseen,       ///< the loads put no torque on the spring, or the measurements do not see its movement
  kInseparable,  ///< its effect is a mixture of other springs' effects
};

/// What equations A c = b, whose rows all have standard deviation 1, say about the unknowns c.
struct Identifiability {
  std::vector<Visibility> visibility;  ///< of each unknown
  int rank = 0;
  double condition_number = 1;   ///< of the columns that can be told apart, each scaled to length 1
  std::vector<int> independent;  ///< unknowns whose columns span all that is seen, `rank` of them, increasing
};

/// `a` [rows x n]; `largest` [rows x n] is the size that each entry would have with the load and the measured
/// direction square to the spring's lever. A spring is unseen when its column is below 1e-3 of that:
/// misalignment gives as much. The first `preferred` columns are judged among themselves: dependent below
/// 1e-6 of the largest singular value of the scaled columns, and all those that take part in a dependence are
/// inseparable. Each further column is visible where it is not a mixture of the preferred ones and of the
/// visible ones before it, to 1e-3 of its length; else it is inseparable, and its effect is theirs.
Identifiability identifiability(const Eigen::MatrixXd& a, const Eigen::MatrixXd& largest,
                                Eigen::Index preferred);

}  // namespace stablecut::robot
