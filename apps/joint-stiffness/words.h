// What joint-stiffness says about an identification: the facts of lib/robot in words.
#pragma once

#include <string>
#include <vector>

#include "document/kinds/load_samples_json.h"
#include "document/kinds/measurement_plan_json.h"
#include "robot/identification.h"
#include "robot/robot.h"

namespace stablecut {

/// Why there is no answer where no joint could be identified.
std::string nothing_identified_text(const robot::Identification& found, const robot::Robot& robot);

/// Warnings of an identification, in the order in which they are given; `source` is the samples' name.
std::vector<std::string> identification_warnings(const robot::Identification& found,
                                                 const robot::Robot& robot,
                                                 const document::LoadSamplesDocument& samples,
                                                 const std::string& source, bool huber);

/// By how much a richer model predicts blocks of neighbouring poses better than the one with joints alone;
/// empty where none is chosen.
std::string richer_model_text(const robot::Identification& found);

/// Warnings of a plan: joints that it does not identify, or whose expected stiffness it finds to no better
/// than itself.
std::vector<std::string> plan_warnings(const document::PlanDocument& document, const robot::Robot& robot);

/// A warning where no robot yields as much or as little as the samples say; empty where it may.
std::string unit_warning(const document::LoadSamplesDocument& samples, const std::string& source);

}  // namespace stablecut
