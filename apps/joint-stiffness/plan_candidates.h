// The measurements that a plan chooses from, and what it is worth against model error.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "document/kinds/measurement_plan_json.h"

namespace stablecut {

/// What the options of a plan say; left out: 600 N along x, y and -z, 0.005 mm, the tool point.
struct PlanRequest {
  using Vector = std::optional<std::array<double, 3>>;
  std::vector<std::array<double, 3>> loads_n;  ///< base frame
  std::optional<double> std_mm;
  Vector load_point_mm, measuring_point_mm;  ///< flange frame
};

struct PlanCandidates {
  std::vector<robot::LoadSample> samples;
  std::vector<int> pose;  ///< of each sample, index in the list
  std::string outside;    ///< which poses are left out since they are outside the joint limits; empty: none
};

/// Every pose inside the joint limits with every load.
PlanCandidates plan_candidates(const robot::Robot& robot, const std::vector<robot::JointAngles>& poses,
                               const PlanRequest& request);

/// What the plan gives where the robot differs from the expected joints by their document's discrepancy, or
/// by a tenth of each deflection where it states none.
void add_model_error(const robot::Robot& robot, const robot::PlanOptions& options,
                     document::PlanDocument& document);

}  // namespace stablecut
