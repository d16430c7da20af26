// Kind `tool-joint`: the identified joint between tool and holder.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "document/text/node.h"
#include "receptance/joint_identification.h"

namespace stablecut::document {

struct ToolJointDocument {
  std::array<std::optional<receptance::JointEstimate>, 2> estimate;  ///< in x and in y, at least one
  receptance::JointObjective objective = receptance::JointObjective::kComplex;
  Eigen::Index lines = 0;       ///< that it was identified on
  double lo_hz = 0, hi_hz = 0;  ///< first and last of them
};

/// The document without provenance: {"x": ..., "y": ...} when both were measured, else the one direction's
/// values, and its name.
Json tool_joint_to_json(const ToolJointDocument& document);

/// The four values of {"k1_n_per_m", ...}. Throws DataError.
receptance::ToolJoint tool_joint_from(const Node& node);

/// A value that its identification calls not identifiable.
struct DoubtfulJointValue {
  std::string place;  ///< document and JSON pointer, as messages name it
  double value = 0;   ///< in the unit of its field
  bool at_bound = false;
  std::optional<double> relative_deviation;  ///< standard deviation over the value, where the document has it
};

struct ToolJoints {
  std::array<receptance::ToolJoint, 2> joint;  ///< in x and in y
  std::string only;  ///< the one direction that was identified, whose joint serves both; else empty
  std::vector<DoubtfulJointValue> doubts;  ///< once where x and y are the same
};

/// Throws DataError.
ToolJoints tool_joints_from_json(const Json& document, const Source& source);

}  // namespace stablecut::document
