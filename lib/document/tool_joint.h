// Kind `tool-joint`: the identified joint between tool and holder.
#pragma once

#include <array>
#include <optional>

#include "document/json_text.h"
#include "receptance/joint_identification.h"

namespace stablecut {

struct ToolJointDocument {
  std::array<std::optional<JointEstimate>, 2> estimate;  ///< in x and in y, at least one
  JointObjective objective = JointObjective::kComplex;
  Eigen::Index lines = 0;
  double lo_hz = 0, hi_hz = 0;
};

/// The document without provenance: {"x": ..., "y": ...} when both were measured, else the one direction's
/// values, and its name.
Json tool_joint_to_json(const ToolJointDocument& document);

/// The joint in x and in y; the same where the document has one for both. Throws DataError.
std::array<ToolJoint, 2> tool_joints_from_json(const Json& document, const Source& source);

/// k1_n_per_m and so on, in the order of JointValues.
extern const std::array<const char*, 4> kJointFields;

/// `complex`, `amplitude`.
const char* objective_name(JointObjective objective);

}  // namespace stablecut
