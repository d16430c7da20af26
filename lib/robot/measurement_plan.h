// Which poses and loads to measure so that the joints are known best (D-optimal design). README.md,
// "Measurement plan".
#pragma once

#include <vector>

#include "robot/identifiability.h"
#include "robot/load_sample.h"

namespace stablecut::robot {

struct MeasurementPlan {
  std::vector<int> chosen;          ///< indices of candidates, increasing; repeats are allowed
  Identifiability identifiability;  ///< of the chosen ones
  JointAngles compliance_std;       ///< that they would give, rad/(N m); NaN where a joint is not visible
  double efficiency = 1;            ///< lower bound of the D-efficiency against any design on the candidates
};

/// Chooses `count` of the candidates, which state their standard deviations, so that the determinant of the
/// information on all joints that the candidates can see is as large as found: a greedy choice, then
/// exchanges of one for another while they gain. A candidate may be chosen several times. Throws NoAnswer
/// when the candidates see no joint, or `count` measurements are too few for the joints they see.
MeasurementPlan plan_measurements(const Robot& robot, const std::vector<LoadSample>& candidates,
                                  const std::array<bool, 3>& components, int count);

}  // namespace stablecut::robot
