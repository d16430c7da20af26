#include "document/kinds/tool_joint_json.h"

namespace stablecut::document {
namespace {

// In the order of JointValues.
constexpr std::array<const char*, 4> kJointFields = {"k1_n_per_m", "c1_n_s_per_m", "k2_n_m_per_rad",
                                                     "c2_n_m_s_per_rad"};

const char* objective_name(receptance::JointObjective objective) {
  return objective == receptance::JointObjective::kAmplitude ? "amplitude" : "complex";
}

Json estimate_to_json(const receptance::JointEstimate& estimate, receptance::JointObjective objective) {
  Json item, deviation;
  const receptance::JointValues values = receptance::values_of(estimate.joint);
  for (std::size_t i = 0; i < values.size(); ++i) {
    item[kJointFields[i]] = values[i];
    deviation[kJointFields[i]] = estimate.at_bound[i] ? Json(nullptr) : Json(estimate.deviation[i]);
  }
  item["std"] = deviation;
  item["identifiable"] = estimate.identifiable;
  item["at_bound"] = estimate.at_bound;
  item["residual"] = estimate.residual;
  item["objective"] = {{"name", objective_name(objective)}, {"value_m_per_n", estimate.objective}};
  return item;
}

receptance::ToolJoint joint_at(const Node& node) {
  node.check_document_names({"direction", "lines", "band_hz", "k1_n_per_m", "c1_n_s_per_m", "k2_n_m_per_rad",
                             "c2_n_m_s_per_rad", "std", "identifiable", "at_bound", "residual", "objective"});
  return tool_joint_from(node);
}

// One flag per value; all `missing` without the field.
std::array<bool, 4> flags_at(const Node& node, const char* name, bool missing) {
  std::array<bool, 4> flags;
  flags.fill(missing);
  const auto list = node.find(name);
  if (!list) return flags;
  const std::vector<Node> items = list->items();
  if (items.size() != flags.size()) list->fail("expected a list of 4: of k1, c1, k2, c2");
  for (std::size_t i = 0; i < flags.size(); ++i) flags[i] = items[i].boolean();
  return flags;
}

void find_doubts(const Node& node, const std::string& directions, std::vector<DoubtfulJointValue>& doubts) {
  const std::array<bool, 4> identifiable = flags_at(node, "identifiable", true),
                            at_bound = flags_at(node, "at_bound", false);
  const receptance::JointValues values = receptance::values_of(tool_joint_from(node));
  const auto deviations = node.find("std");
  for (std::size_t i = 0; i < values.size(); ++i) {
    std::optional<double> relative;
    const auto deviation = deviations ? deviations->find(kJointFields[i]) : std::nullopt;
    if (deviation && !deviation->is_null()) relative = deviation->number(kNotNegative) / values[i];
    if (identifiable[i]) continue;
    doubts.push_back({node.source().name + ": " + node.at(kJointFields[i]).pointer() + directions, values[i],
                      at_bound[i], values[i] > 0 ? relative : std::nullopt});
  }
}

}  // namespace

receptance::ToolJoint tool_joint_from(const Node& node) {
  return {node.at("k1_n_per_m").number(kPositive), node.at("c1_n_s_per_m").number(kNotNegative),
          node.at("k2_n_m_per_rad").number(kPositive), node.at("c2_n_m_s_per_rad").number(kNotNegative)};
}

Json tool_joint_to_json(const ToolJointDocument& document) {
  Json result = {{"format", "stablecut/tool-joint/1"},
                 {"lines", document.lines},
                 {"band_hz", {document.lo_hz, document.hi_hz}}};
  const bool both = document.estimate[0] && document.estimate[1];
  for (std::size_t d = 0; d < 2; ++d) {
    if (!document.estimate[d]) continue;
    const char* name = d == 0 ? "x" : "y";
    const Json item = estimate_to_json(*document.estimate[d], document.objective);
    if (both) {
      result[name] = item;
    } else {
      result["direction"] = name;
      result.update(item);
    }
  }
  return result;
}

ToolJoints tool_joints_from_json(const Json& document, const Source& source) {
  const Node root = document_root(document, source, "tool-joint");
  if (!root.has("x") && !root.has("y")) {
    const receptance::ToolJoint joint = joint_at(root);
    const auto direction = root.find("direction");
    ToolJoints joints{{joint, joint}, direction ? direction->word({"x", "y"}) : "", {}};
    find_doubts(root, "", joints.doubts);
    return joints;
  }
  root.check_document_names({"lines", "band_hz", "x", "y"});
  const Node x = root.at("x"), y = root.at("y");
  ToolJoints joints{{joint_at(x), joint_at(y)}, "", {}};
  const bool same = x.json() == y.json();
  find_doubts(x, same ? " and in y" : "", joints.doubts);
  if (!same) find_doubts(y, "", joints.doubts);
  return joints;
}

}  // namespace stablecut::document
