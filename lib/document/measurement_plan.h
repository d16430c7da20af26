// Kind `measurement-plan`: the poses and loads to measure.
#pragma once

#include <optional>
#include <vector>

#include "document/json_text.h"
#include "robot/joint_stiffness.h"
#include "robot/measurement_plan.h"

namespace stablecut {

struct PlanDocument {
  MeasurementPlan plan;
  std::vector<LoadSample> candidates;
  std::vector<int> pose;                   ///< of each candidate, 0-based in the pose list
  std::optional<JointStiffness> expected;  ///< for deviations of the stiffness
};

/// The document without provenance.
Json plan_to_json(const PlanDocument& document, const Robot& robot);

}  // namespace stablecut
