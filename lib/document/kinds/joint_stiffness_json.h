// Kind `joint-stiffness`: K_theta, with what is not known as null.
#pragma once

#include <string>
#include <vector>

#include "document/text/json_text.h"
#include "robot/identification.h"
#include "robot/joint_stiffness.h"

namespace stablecut::document {

/// How documents call a spring: "base.x", "A2.y" of a bearing, "A2.z" of a joint.
std::string spring_name(const robot::Spring& spring, const robot::Robot& robot);

/// "joints", "base" or "three-axis".
const char* model_name(robot::ElasticModel model);

/// Reads stiffness, the springs of a richer model, the compliances' covariance (or their deviations from std)
/// and the discrepancy, those that are given. Throws DataError; also where the document names other joints
/// than the robot's, or springs that its model does not have.
robot::JointStiffness joint_stiffness_from_json(const Json& document, const Source& source,
                                                const robot::Robot& robot);

struct IdentificationDocument {
  robot::Identification identification;
  robot::IdentificationOptions options;
  std::vector<std::string> places;  ///< of the samples
  std::vector<std::string> names;   ///< of the samples; empty where one has none
};

/// The document without provenance.
Json identification_to_json(const IdentificationDocument& document, const robot::Robot& robot);

/// Why a joint, or another spring of that model, has no stiffness, in words; empty for one that has.
std::string verdict_text(robot::Verdict verdict,
                         robot::ElasticModel model = robot::ElasticModel::kJointsOnly);

}  // namespace stablecut::document
