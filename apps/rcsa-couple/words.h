// The sentences of rcsa-couple: warnings and errors from the findings of the libraries.
#pragma once

#include <string>

#include "document/kinds/assembly_json.h"
#include "receptance/joint_identification.h"

namespace stablecut {

/// A warning, beginning with the place of the measurement.
std::string words_of(const document::HolderFinding& finding);

/// Whether a finding leaves no answer, so that its words are an error and not a warning.
bool is_failure(const receptance::JointFinding& finding);

/// A warning or an error. `direction` names the direction or directions, `tap` the file of the measured tip.
std::string words_of(const receptance::JointFinding& finding, const std::string& direction,
                     const std::string& tap);

}  // namespace stablecut
