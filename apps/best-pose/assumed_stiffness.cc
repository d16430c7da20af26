#include "assumed_stiffness.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/error.h"
#include "base/number_text.h"
#include "base/range.h"
#include "cli/exit_status.h"

namespace stablecut {
namespace {

void assume(const AssumedStiffness& assumed, const robot::Robot& robot, const document::Source& source,
            robot::JointStiffness& joints) {
  const auto& [name, value] = assumed;
  const auto joint = std::find_if(robot.joints.begin(), robot.joints.end(),
                                  [&name = name](const robot::Joint& known) { return known.name == name; });
  if (joint == robot.joints.end()) {
    std::string names;
    for (const robot::Joint& known : robot.joints) names += (names.empty() ? "" : ", ") + known.name;
    throw cli::WrongUsage("--assume: " + name + ": expected one of " + names);
  }
  auto& stiffness = joints.stiffness[joint - robot.joints.begin()];
  cli::refuse_if(stiffness.has_value(), "--assume: " + name + ": " + source.name +
                                            " has a stiffness for it: expected a joint without");
  stiffness = value;
}

[[noreturn]] void fail_for_missing(const robot::JointStiffness& joints, const robot::Robot& robot,
                                   const document::Source& source) {
  std::string missing, option, bounds;
  std::size_t first = robot::kJoints;
  for (std::size_t j = 0; j < robot::kJoints; ++j) {
    if (joints.stiffness[j]) continue;
    first = std::min(first, j);
    missing += (missing.empty() ? "" : ", ") + robot.joints[j].name;
    option += " --assume " + robot.joints[j].name + "=K";
    if (!joints.least[j]) continue;
    bounds +=
        (bounds.empty() ? "" : ", ") + robot.joints[j].name + " above " + number_text(*joints.least[j], 3);
  }
  std::string text = source.name + ": /stiffness_n_m_per_rad/" + std::to_string(first) +
                     ": null: " + missing +
                     " not identified: expected a stiffness for every joint; give one for it with" + option;
  if (!bounds.empty()) text += " (by its 95 % interval " + bounds + " N m/rad)";
  if (missing == robot.joints.back().name && robot::tool_alignment(robot).point_on_axis) {
    text += " (any K: the tool point lies on this joint's axis, so it does not change the answer)";
  }
  throw NoAnswer(text);
}

}  // namespace

AssumedStiffness parse_assumed(const std::string& text) {
  const auto equals = text.find('=');
  const auto value = equals == std::string::npos ? std::nullopt : parse_number(text.substr(equals + 1));
  if (!value || !(*value > 0) || !std::isfinite(1 / *value) || equals == 0) {
    throw cli::WrongUsage("--assume: " + text + ": expected JOINT=K with a stiffness above 0 N m/rad");
  }
  return {text.substr(0, equals), *value};
}

robot::Elasticity complete_elasticity(robot::JointStiffness joints,
                                      const std::vector<AssumedStiffness>& assumed, const robot::Robot& robot,
                                      const document::Source& source) {
  for (const AssumedStiffness& one : assumed) assume(one, robot, source, joints);
  robot::JointAngles compliance;
  for (int j = 0; j < robot::kJoints; ++j) {
    if (!joints.stiffness[j]) fail_for_missing(joints, robot, source);
    compliance[j] = 1 / *joints.stiffness[j];
  }
  robot::Elasticity elasticity = robot::joints_only(compliance);
  const auto others = static_cast<Eigen::Index>(joints.others.size());
  elasticity.springs.insert(elasticity.springs.end(), joints.others.begin(), joints.others.end());
  elasticity.compliance.conservativeResize(robot::kJoints + others);
  for (Eigen::Index i = 0; i < others; ++i)
    elasticity.compliance[robot::kJoints + i] = joints.other_compliance[i].value_or(0);
  return elasticity;
}

}  // namespace stablecut
