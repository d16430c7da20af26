#include "document/kinds/measurement_plan_json.h"

#include <cmath>
#include <set>

#include "base/units.h"
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
  Json names = Json::array(), identifiable = Json::array(), compliance = Json::array();
  for (std::size_t j = 0; j < robot::kJoints; ++j) {
    names.push_back(robot.joints[j].name);
    identifiable.push_back(std::isfinite(plan.compliance_std[j]));
    compliance.push_back(number_or_null(plan.compliance_std[j]));
  }
  std::set<int> poses;
  for (const int k : plan.chosen) poses.insert(document.pose[k]);
  Json result = {{"format", "stablecut/measurement-plan/1"},
                 {"joints", names},
                 {"samples", samples},
                 {"poses", poses.size()},
                 {"moves_deg", degrees_from_radians(plan.moves_rad)},
                 {"identifiable", identifiable},
                 {"rank", plan.identifiability.rank},
                 {"condition_number", plan.identifiability.condition_number},
                 {"std_compliance_rad_per_n_m", compliance},
                 {"efficiency", plan.efficiency}};
  if (!document.expected) return result;
  const auto of_stiffness = [&](const robot::JointAngles& std) {
    Json list = Json::array();
    for (int j = 0; j < robot::kJoints; ++j) {
      const auto& stiffness = document.expected->stiffness[j];
      list.push_back(stiffness ? number_or_null(std[j] * *stiffness * *stiffness) : Json(nullptr));
    }
    return list;
  };
  result["std_n_m_per_rad"] = of_stiffness(plan.compliance_std);
  result["model_error"] = {{"relative", document.discrepancy.relative},
                           {"absolute_um", document.discrepancy.absolute_m * 1e6},
                           {"std_n_m_per_rad", of_stiffness(document.std_with_discrepancy)}};
  return result;
}

}  // namespace stablecut::document
