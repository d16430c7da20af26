// The sentences of rcsa-couple: warnings and errors from the findings of the libraries.
#pragma once

#include <string>
#include <vector>

#include "document/kinds/assembly_json.h"
#include "document/kinds/tool_joint_json.h"
#include "receptance/assembly_identification.h"

namespace stablecut {

/// A warning, beginning with the place of the measurement.
std::string words_of(const document::HolderFinding& finding);

/// A warning, beginning with the place of the value, which says what was likely meant.
std::string words_of(const document::DoubtfulMaterial& material);
std::string words_of(const document::DoubtfulSize& size);

/// A warning, beginning with the place of the value.
std::string words_of(const document::DoubtfulJointValue& value);

/// What to say of identified joints, for the tap of that name. Throws NoAnswer where a direction is
/// unexplained and where no direction tells anything.
std::vector<std::string> warnings_of(const receptance::IdentifiedJoints& joints,
                                     const receptance::JointBounds& bounds,
                                     receptance::JointObjective objective, const std::string& tap);

}  // namespace stablecut
