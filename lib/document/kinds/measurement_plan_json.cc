#include "document/kinds/measurement_plan_json.h"

#include <cmath>

#include "document/kinds/joints_json.h"

namespace stablecut::document {

Json plan_to_json(const PlanDocument& document, const robot::Robot& robot) {
  const robot::MeasurementPlan& plan = document.plan;
  Json samples = Json::array();
  for (const int k : plan.chosen) {
    const robot::LoadSample& sample = document.candidates[k];
    samples.push_back({{"pose", document.pose[k] + 1},
                       {"joints_deg", joint_angles_to_json(sample.angles)},
                       {"force_n", {sample.force_n[0], sample.force_n[1], sample.force_n[2]}}});
    const std::string& name = document.names[document.pose[k]];
    if (!name.empty()) samples.back()["name"] = name;
  }
  Json names = Json::array(), identifiable = Json::array(), compliance = Json::array(),
       stiffness = Json::array();
  for (std::size_t j = 0; j < robot::kJoints; ++j) {
    const double std = plan.compliance_std[j];
    names.push_back(robot.joints[j].name);
    identifiable.push_back(std::isfinite(std));
    compliance.push_back(number_or_null(std));
    const bool known = document.expected && document.expected->stiffness[j];
    stiffness.push_back(known ? number_or_null(std * std::pow(*document.expected->stiffness[j], 2))
                              : Json(nullptr));
  }
  Json result = {{"format", "stablecut/measurement-plan/1"},
                 {"joints", names},
                 {"samples", samples},
                 {"identifiable", identifiable},
                 {"rank", plan.identifiability.rank},
                 {"condition_number", plan.identifiability.condition_number},
                 {"std_compliance_rad_per_n_m", compliance},
                 {"efficiency", plan.efficiency}};
  if (document.expected) result["std_n_m_per_rad"] = stiffness;
  return result;
}

}  // namespace stablecut::document
