#include <algorithm>
#include <cmath>

#include "document/kinds/joint_stiffness_json.h"
#include "document/kinds/joints_json.h"

namespace stablecut::document {
namespace {

template <typename Value>
Json list_of(const Value& value) {
  Json list = Json::array();
  for (int j = 0; j < robot::kJoints; ++j) list.push_back(value(j));
  return list;
}

Json micrometres(const std::optional<double>& metres) { return metres ? Json(*metres * 1e6) : Json(nullptr); }

// Of a spring that has a compliance in the document: a joint that is identified, another with an estimate.
bool is_stated(const robot::Identification& found, int spring) {
  const robot::Verdict verdict = found.verdict[spring];
  return verdict == robot::Verdict::kIdentified ||
         (spring >= robot::kJoints && verdict == robot::Verdict::kUncertain);
}

// A stiffness interval is the inverse of the compliance's; that of an uncertain joint has no upper end.
Json stiffness_interval(const robot::Identification& found, int joint) {
  if (!found.deviations_known || !(found.high[joint] > 0)) return nullptr;
  if (found.identified(joint)) return Json::array({1 / found.high[joint], 1 / found.low[joint]});
  if (found.verdict[joint] != robot::Verdict::kUncertain) return nullptr;
  return Json::array({1 / found.high[joint], nullptr});
}

// The springs after the joints.
Json springs_to_json(const robot::Identification& found, const robot::Robot& robot) {
  Json list = Json::array();
  for (int k = robot::kJoints; k < static_cast<int>(found.springs.size()); ++k) {
    const robot::Spring& spring = found.springs[k];
    const std::string unit = spring.kind == robot::Spring::Kind::kBase ? "m_per_n" : "rad_per_n_m";
    const bool stated = is_stated(found, k), spread = stated && found.deviations_known;
    list.push_back({{"name", spring_name(spring, robot)},
                    {"compliance_" + unit, stated ? Json(found.compliance[k]) : Json(nullptr)},
                    {"std_" + unit, spread ? Json(std::sqrt(found.covariance(k, k))) : Json(nullptr)},
                    {"interval_95_" + unit,
                     spread ? Json::array({std::max(0.0, found.low[k]), found.high[k]}) : Json(nullptr)},
                    {"identifiable", found.identified(k)},
                    {"reason", found.identified(k) ? Json(nullptr)
                                                   : Json(verdict_text(found.verdict[k], found.model))}});
  }
  return list;
}

Json spring_covariance_to_json(const robot::Identification& found, const robot::Robot& robot) {
  if (!found.deviations_known) return nullptr;
  std::vector<int> stated;
  for (int k = 0; k < static_cast<int>(found.springs.size()); ++k) {
    if (is_stated(found, k)) stated.push_back(k);
  }
  Json names = Json::array(), matrix = Json::array();
  for (const int i : stated) {
    names.push_back(spring_name(found.springs[i], robot));
    Json row = Json::array();
    for (const int k : stated) row.push_back(found.covariance(i, k));
    matrix.push_back(std::move(row));
  }
  return {{"springs", std::move(names)}, {"matrix", std::move(matrix)}};
}

Json models_to_json(const robot::ModelChoice& models) {
  Json list = Json::array();
  for (const robot::ModelTrial& trial : models.trials) {
    list.push_back({{"model", model_name(trial.model)},
                    {"springs", trial.springs},
                    {"residual_rms_um", trial.residual_rms_m * 1e6},
                    {"block_rms_um", micrometres(trial.block_rms_m)}});
  }
  return list;
}

Json outliers_to_json(const IdentificationDocument& document) {
  Json outliers = Json::array();
  for (const robot::Outlier& outlier : document.identification.outliers) {
    outliers.push_back({{"sample", outlier.sample},
                        {"place", document.places[outlier.sample]},
                        {"residual_um", outlier.residual_m * 1e6},
                        {"deviations", outlier.deviations},
                        {"weight", outlier.weight}});
    if (!document.names[outlier.sample].empty()) outliers.back()["name"] = document.names[outlier.sample];
  }
  return outliers;
}

}  // namespace

std::string verdict_text(robot::Verdict verdict, robot::ElasticModel model) {
  switch (verdict) {
    case robot::Verdict::kIdentified:
      return "";
    case robot::Verdict::kUnseen:
      return "the loads and measurements do not see it";
    case robot::Verdict::kInseparable:
      return model == robot::ElasticModel::kJointsOnly ? "its effect cannot be told from other joints'"
                                                       : "its effect cannot be told from other springs'";
    case robot::Verdict::kUncertain:
      return "the 95 % interval of its compliance reaches 0: it may as well be rigid";
  }
  return "";
}

Json identification_to_json(const IdentificationDocument& document, const robot::Robot& robot) {
  const robot::Identification& found = document.identification;
  const auto known = [&](int j) { return found.identified(j) && found.deviations_known; };
  const auto stiffness = [&](int j) { return 1 / found.compliance[j]; };
  const bool joints_alone = found.model == robot::ElasticModel::kJointsOnly;
  Json result = {{"format", "stablecut/joint-stiffness/1"},
                 {"joints", list_of([&](int j) { return Json(robot.joints[j].name); })},
                 {"model", model_name(found.model)},
                 {"stiffness_n_m_per_rad",
                  list_of([&](int j) { return found.identified(j) ? Json(stiffness(j)) : Json(nullptr); })},
                 {"interval_95_n_m_per_rad", list_of([&](int j) { return stiffness_interval(found, j); })},
                 {"std_n_m_per_rad", list_of([&](int j) {
                    return known(j) ? Json(std::sqrt(found.covariance(j, j)) * std::pow(stiffness(j), 2))
                                    : Json(nullptr);
                  })},
                 {"identifiable", list_of([&](int j) { return Json(found.identified(j)); })},
                 {"reasons", list_of([&](int j) {
                    return found.identified(j) ? Json(nullptr)
                                               : Json(verdict_text(found.verdict[j], found.model));
                  })}};
  if (!joints_alone) result["springs"] = springs_to_json(found, robot);
  result["models"] = models_to_json(found.models);
  result["rank"] = found.rank;
  result["condition_number"] = found.condition_number;
  result["residual_rms_um"] = found.residual_rms_m * 1e6;
  if (found.residual_rms_rad) result["residual_rms_rad"] = *found.residual_rms_rad;
  if (found.deviations_known) {
    result["covariance_compliance"] = list_of([&](int i) {
      return list_of(
          [&](int j) { return known(i) && known(j) ? Json(found.covariance(i, j)) : Json(nullptr); });
    });
  } else {
    result["covariance_compliance"] = nullptr;
  }
  if (!joints_alone) result["spring_covariance"] = spring_covariance_to_json(found, robot);
  result["discrepancy"] = {{"relative", found.discrepancy.relative},
                           {"absolute_um", found.discrepancy.absolute_m * 1e6},
                           {"force_n", found.discrepancy.force_n}};
  result["model_error"] = found.model_error;
  result["degrees_of_freedom"] = number_or_null(found.degrees_of_freedom);
  if (found.chi_square_per_dof) result["chi_square_per_dof"] = *found.chi_square_per_dof;
  const robot::CrossValidation& cross = found.cross_validation;
  result["cross_validation"] = {{"rms_um", micrometres(cross.rms_m)},
                                {"block_rms_um", micrometres(cross.block_rms_m)},
                                {"poses", cross.poses},
                                {"blocks", cross.blocks},
                                {"samples_not_predicted", cross.samples_not_predicted}};
  result["samples"] = document.places.size();
  result["loss"] = document.options.huber ? "huber" : "squared";
  std::string components;
  for (std::size_t d = 0; d < 3; ++d) {
    if (document.options.components[d]) components += "xyz"[d];
  }
  result["components"] = components;
  result["outliers"] = outliers_to_json(document);
  return result;
}

}  // namespace stablecut::document
