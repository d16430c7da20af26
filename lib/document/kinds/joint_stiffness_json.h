// Kind `joint-stiffness`: K_theta, with what is not known as null.
#pragma once

#include <string>
#include <vector>

#include "document/text/json_text.h"
#include "robot/identification.h"
#include "robot/joint_stiffness.h"

namespace stablecut::document {

/// Reads stiffness and, where given, the compliances' covariance (or their deviations from std). Throws
/// DataError; also where the document names other joints than the robot's.
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

/// Why a joint has no stiffness, in words; empty for one that has.
std::string verdict_text(robot::JointVerdict verdict);

}  // namespace stablecut::document
