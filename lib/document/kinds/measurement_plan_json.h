// Kind `measurement-plan`: the poses and loads to measure.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "document/text/json_text.h"
#include "robot/joint_stiffness.h"
#include "robot/measurement_plan.h"

namespace stablecut::document {

struct PlanDocument {
  robot::MeasurementPlan plan;
  std::vector<robot::LoadSample> candidates;
  std::vector<int> pose;                          ///< of each candidate, 0-based in the pose list
  std::vector<std::string> names;                 ///< of the pose list's poses; empty where one has none
  std::optional<robot::JointStiffness> expected;  ///< for deviations of the stiffness
  /// With an expected stiffness: what the robot may be off by beside it, and the compliances' deviations
  /// then.
  robot::Discrepancy discrepancy;
  robot::JointAngles std_with_discrepancy;
};

/// The document without provenance.
Json plan_to_json(const PlanDocument& document, const robot::Robot& robot);

}  // namespace stablecut::document
