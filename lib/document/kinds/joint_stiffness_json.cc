#include "document/kinds/joint_stiffness_json.h"

#include <Eigen/Eigenvalues>
#include <cmath>

#include "base/units.h"
#include "document/kinds/joints_json.h"

namespace stablecut::document {
namespace {

constexpr Bound kStiffness{.least = 0, .open_least = true, .words = "a stiffness above 0 N m/rad, or null"};

template <typename Value>
Json list_of(const Value& value) {
  Json list = Json::array();
  for (int j = 0; j < robot::kJoints; ++j) list.push_back(value(j));
  return list;
}

robot::Matrix6d covariance_from(const Node& node, const robot::JointStiffness& joints) {
  const auto rows = node.items();
  if (rows.size() != robot::kJoints) node.fail("expected 6 rows");
  robot::Matrix6d covariance = robot::Matrix6d::Zero();
  for (std::size_t i = 0; i < robot::kJoints; ++i) {
    if (rows[i].is_null()) continue;
    const auto items = rows[i].items();
    if (items.size() != robot::kJoints)
      rows[i].fail("expected 6 numbers, or null for a row that is not known");
    for (std::size_t j = 0; j < robot::kJoints; ++j) {
      if (!items[j].is_null()) covariance(i, j) = items[j].number();
    }
    if (!joints.stiffness[i]) covariance.row(i).setZero();
  }
  for (std::size_t j = 0; j < robot::kJoints; ++j) {
    if (!joints.stiffness[j]) covariance.col(j).setZero();
  }
  const double size = covariance.diagonal().cwiseAbs().maxCoeff();
  const double skew = (covariance - covariance.transpose()).cwiseAbs().maxCoeff();
  if (skew > 1e-6 * size ||
      Eigen::SelfAdjointEigenSolver<robot::Matrix6d>(covariance, Eigen::EigenvaluesOnly).eigenvalues()[0] <
          -1e-6 * size) {
    node.fail("expected a covariance matrix: symmetric, without negative eigenvalues");
  }
  return covariance;
}

// The stiffness of another robot is none of this one's.
void check_joint_names(const Node& joints, const robot::Robot& robot) {
  const auto items = joints.items();
  if (items.size() != robot::kJoints) joints.fail("expected 6 names of joints");
  for (std::size_t j = 0; j < robot::kJoints; ++j) {
    const std::string& name = robot.joints[j].name;
    if (items[j].text() != name)
      items[j].fail("expected \"" + name + "\", as in the robot document: is it this robot's?");
  }
}

}  // namespace

robot::JointStiffness joint_stiffness_from_json(const Json& document, const Source& source,
                                                const robot::Robot& robot) {
  const Node root = document_root(document, source, "joint-stiffness");
  root.check_names({"format",
                    "joints",
                    "stiffness_n_m_per_rad",
                    "interval_95_n_m_per_rad",
                    "std_n_m_per_rad",
                    "identifiable",
                    "reasons",
                    "rank",
                    "condition_number",
                    "residual_rms_um",
                    "residual_rms_rad",
                    "covariance_compliance",
                    "cross_validation",
                    "degrees_of_freedom",
                    "chi_square_per_dof",
                    "loss",
                    "components",
                    "samples",
                    "outliers",
                    "provenance"});
  if (const auto names = root.find("joints")) check_joint_names(*names, robot);
  robot::JointStiffness joints;
  const Node stiffness = root.at("stiffness_n_m_per_rad");
  const auto items = stiffness.items();
  if (items.size() != robot::kJoints) stiffness.fail("expected 6 numbers, null where unknown");
  for (std::size_t j = 0; j < robot::kJoints; ++j) {
    if (!items[j].is_null()) joints.stiffness[j] = items[j].number(kStiffness);
  }
  if (const auto covariance = root.find("covariance_compliance"); covariance && !covariance->is_null()) {
    joints.compliance_covariance = covariance_from(*covariance, joints);
  } else if (const auto std = root.find("std_n_m_per_rad"); std && !std->is_null()) {
    const auto deviations = std->items();
    if (deviations.size() != robot::kJoints) std->fail("expected 6 numbers, null where unknown");
    robot::Matrix6d diagonal = robot::Matrix6d::Zero();
    for (std::size_t j = 0; j < robot::kJoints; ++j) {
      if (deviations[j].is_null() || !joints.stiffness[j]) continue;
      diagonal(j, j) = std::pow(deviations[j].number(kNotNegative) / std::pow(*joints.stiffness[j], 2), 2);
    }
    joints.compliance_covariance = diagonal;
  }
  return joints;
}

std::string verdict_text(robot::JointVerdict verdict) {
  switch (verdict) {
    case robot::JointVerdict::kIdentified:
      return "";
    case robot::JointVerdict::kUnseen:
      return "the loads and measurements do not see it";
    case robot::JointVerdict::kInseparable:
      return "its effect cannot be told from other joints'";
    case robot::JointVerdict::kUncertain:
      return "the 95 % interval of its compliance reaches 0: it may as well be rigid";
  }
  return "";
}

Json identification_to_json(const IdentificationDocument& document, const robot::Robot& robot) {
  const robot::Identification& found = document.identification;
  const auto at = [](int j) { return j; };
  const auto known = [&](int j) { return found.identified(j) && found.deviations_known; };
  const auto stiffness = [&](int j) { return 1 / found.compliance[j]; };
  Json result = {
      {"format", "stablecut/joint-stiffness/1"},
      {"joints", list_of([&](int j) { return Json(robot.joints[at(j)].name); })},
      {"stiffness_n_m_per_rad",
       list_of([&](int j) { return found.identified(j) ? Json(stiffness(j)) : Json(nullptr); })},
      {"interval_95_n_m_per_rad", list_of([&](int j) {
         return known(j) ? Json::array({1 / found.high[at(j)], 1 / found.low[at(j)]}) : Json(nullptr);
       })},
      {"std_n_m_per_rad", list_of([&](int j) {
         return known(j) ? Json(std::sqrt(found.covariance(j, j)) * std::pow(stiffness(j), 2))
                         : Json(nullptr);
       })},
      {"identifiable", list_of([&](int j) { return Json(found.identified(j)); })},
      {"reasons", list_of([&](int j) {
         return found.identified(j) ? Json(nullptr) : Json(verdict_text(found.verdict[at(j)]));
       })},
      {"rank", found.rank},
      {"condition_number", found.condition_number},
      {"residual_rms_um", found.residual_rms_m * 1e6}};
  if (found.residual_rms_rad) result["residual_rms_rad"] = *found.residual_rms_rad;
  if (found.deviations_known) {
    result["covariance_compliance"] = list_of([&](int i) {
      return list_of(
          [&](int j) { return known(i) && known(j) ? Json(found.covariance(i, j)) : Json(nullptr); });
    });
  } else {
    result["covariance_compliance"] = nullptr;
  }
  result["degrees_of_freedom"] = number_or_null(found.degrees_of_freedom);
  if (found.chi_square_per_dof) result["chi_square_per_dof"] = *found.chi_square_per_dof;
  Json cross = {{"rms_um", nullptr}, {"samples_not_predicted", found.cross_validation.samples_not_predicted}};
  if (found.cross_validation.rms_m) cross["rms_um"] = *found.cross_validation.rms_m * 1e6;
  result["cross_validation"] = std::move(cross);
  result["samples"] = document.places.size();
  result["loss"] = document.options.huber ? "huber" : "squared";
  std::string components;
  for (std::size_t d = 0; d < 3; ++d) {
    if (document.options.components[d]) components += "xyz"[d];
  }
  result["components"] = components;
  Json outliers = Json::array();
  for (const robot::Outlier& outlier : found.outliers) {
    outliers.push_back({{"sample", outlier.sample},
                        {"place", document.places[at(outlier.sample)]},
                        {"residual_um", outlier.residual_m * 1e6},
                        {"deviations", outlier.deviations},
                        {"weight", outlier.weight}});
    if (!document.names[at(outlier.sample)].empty())
      outliers.back()["name"] = document.names[at(outlier.sample)];
  }
  result["outliers"] = std::move(outliers);
  return result;
}

}  // namespace stablecut::document
