// Which poses and loads to measure so that the joints are known best (D-optimal design). README.md,
// "Measurement plan".
#pragma once

#include <array>
#include <vector>

#include "robot/discrepancy.h"
#include "robot/load_sample.h"

namespace stablecut::robot {

struct PlanOptions {
  int count = 1;                                        ///< measurements to choose
  bool repeats = false;                                 ///< a candidate may be chosen several times
  std::array<bool, 3> components = {true, true, true};  ///< of the deflection
};

struct MeasurementPlan {
  std::vector<int> chosen;          ///< indices of candidates, in an order of short moves
  Identifiability identifiability;  ///< of the chosen ones
  JointAngles compliance_std;       ///< that they would give, rad/(N m); NaN where a joint is not visible
  double efficiency = 1;            ///< lower bound of the D-efficiency against any design on the candidates
  double moves_rad = 0;             ///< sum over the moves of the largest turn of a joint
};

/// Chooses `count` of the candidates, which state their standard deviations, so that the determinant of the
/// information on all joints that the candidates can see is as large as found: a greedy choice, then
/// exchanges of one for another while they gain. Throws NoAnswer when the candidates see no joint, there are
/// fewer of them than asked for, or `count` measurements are too few for the joints they see.
MeasurementPlan plan_measurements(const Robot& robot, const std::vector<LoadSample>& candidates,
                                  const PlanOptions& options);

/// The deviations of the compliances, rad/(N m), that measuring the plan would give by least squares where
/// each sample is also off by a discrepancy from what `joint_compliance` predicts. NaN as in compliance_std.
JointAngles std_with_discrepancy(const Robot& robot, const std::vector<LoadSample>& candidates,
                                 const PlanOptions& options, const MeasurementPlan& plan,
                                 const JointAngles& joint_compliance, const Discrepancy& discrepancy);

}  // namespace stablecut::robot
