// Which poses and loads to measure so that the joints are known best (D-optimal design).
#pragma once

#include <vector>

#include "robot/identifiability.h"
#include "robot/load_sample.h"

namespace stablecut::robot {

struct MeasurementPlan {
  std::vector<int> chosen;          ///< indices of candidates, increasing; one may be there several times
  Identifiability identifiability;  ///< of the chosen ones
  JointAngles compliance_std;       ///< that they would give, rad/(N m); NaN where a joint is not visible
  double efficiency = 1;            ///< at least this D-efficiency against any design on the candidates
};

/// Chooses `count` of the candidates (repeats allowed: measuring twice is a measurement), whose stated
/// deviations count, so that the determinant of the information on all joints that the candidates can see is
/// largest: greedy, then exchanges while they gain. Throws NoAnswer when the candidates see no joint or
/// `count` is too small for those they see.
MeasurementPlan plan_measurements(const Robot& robot, const std::vector<LoadSample>& candidates,
                                  const std::array<bool, 3>& components, int count);

}  // namespace stablecut::robot
