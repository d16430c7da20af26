#include "words.h"

#include <algorithm>

#include "base/number_text.h"
#include "base/units.h"
#include "document/kinds/joint_stiffness_json.h"

namespace stablecut {

std::string nothing_identified_text(const robot::Identification& found, const robot::Robot& robot) {
  std::string text = "no joint can be identified:";
  for (int j = 0; j < robot::kJoints; ++j) {
    text += (j > 0 ? ", " : " ") + robot.joints[j].name;
    switch (found.verdict[j]) {
      case robot::Verdict::kUnseen:
        text += " is not seen by the loads and measurements";
        break;
      case robot::Verdict::kInseparable:
        text += " cannot be told from other joints";
        break;
      case robot::Verdict::kUncertain:
      case robot::Verdict::kIdentified:
        text += " is too uncertain to be told from a rigid joint";
        break;
    }
  }
  if (found.moved_against_loads) {
    text +=
        "; the deflections point against the loads: expected how the robot moves when it is loaded, not how "
        "it "
        "comes back";
  }
  return text;
}

std::vector<std::string> identification_warnings(const robot::Identification& found,
                                                 const robot::Robot& robot,
                                                 const document::LoadSamplesDocument& samples,
                                                 const std::string& source, bool huber) {
  std::vector<std::string> warnings;
  for (int j = 0; j < robot::kJoints; ++j) {
    if (found.identified(j)) continue;
    warnings.push_back("joint " + robot.joints[j].name +
                       " is not identified: " + document::verdict_text(found.verdict[j]));
  }
  for (const robot::Verdict verdict :
       {robot::Verdict::kUnseen, robot::Verdict::kInseparable, robot::Verdict::kUncertain}) {
    std::string names;
    for (std::size_t k = robot::kJoints; k < found.springs.size(); ++k) {
      if (found.verdict[k] == verdict)
        names += (names.empty() ? "" : ", ") + document::spring_name(found.springs[k], robot);
    }
    if (!names.empty())
      warnings.push_back("springs not identified: " + names + ": " +
                         document::verdict_text(verdict, found.model));
  }
  if (!found.deviations_known) {
    warnings.push_back(source +
                       ": as many unknowns as measured values: no standard deviations and no intervals");
  }
  if (found.deviations_contradicted) {
    warnings.push_back(
        source +
        ": the residuals are too large for the stated standard deviations (chi-square per degree "
        "of freedom " +
        number_text(*found.chi_square_per_dof) + "): the standard deviations of the result were scaled up");
  }
  for (const robot::Outlier& outlier : found.outliers) {
    warnings.push_back(source + ": " + samples.places[outlier.sample] + ": " +
                       number_text(outlier.residual_m * 1e6, 3) + " um from the model, " +
                       number_text(outlier.deviations, 3) + " standard deviations" +
                       (huber ? "" : ": an outlier? (--loss huber gives such samples less weight)"));
  }
  return warnings;
}

std::string richer_model_text(const robot::Identification& found) {
  const auto trial = [&](robot::ElasticModel model) {
    return std::find_if(found.models.trials.begin(), found.models.trials.end(),
                        [&](const robot::ModelTrial& one) { return one.model == model; });
  };
  const auto joints = trial(robot::ElasticModel::kJointsOnly), best = trial(found.models.best);
  if (best == joints || best == found.models.trials.end() || joints == found.models.trials.end() ||
      !best->block_rms_m || !joints->block_rms_m) {
    return "";
  }
  const std::string name = document::model_name(found.models.best);
  return "the model " + name + " predicts poses of other blocks to " +
         number_text(*best->block_rms_m * 1e6, 3) + " um, joints alone to " +
         number_text(*joints->block_rms_m * 1e6, 3) + " um: --model " + name + " uses it";
}

std::vector<std::string> plan_warnings(const document::PlanDocument& document, const robot::Robot& robot) {
  std::vector<std::string> warnings;
  for (int j = 0; j < robot::kJoints; ++j) {
    if (document.plan.identifiability.visibility[j] != robot::Visibility::kVisible) {
      warnings.push_back("joint " + robot.joints[j].name +
                         " cannot be identified from these poses and loads");
    } else if (document.expected && document.expected->stiffness[j]) {
      const double share = document.std_with_discrepancy[j] * *document.expected->stiffness[j];
      if (share > 1)
        warnings.push_back("joint " + robot.joints[j].name + ": the plan would find its stiffness to " +
                           percent_text(share) +
                           " (one standard deviation, model error included): more measurements are needed, "
                           "or poses and loads that see more of it");
    }
  }
  return warnings;
}

std::string unit_warning(const document::LoadSamplesDocument& samples, const std::string& source) {
  const double largest = robot::largest_deflection(samples.samples);
  if (robot::plausible_deflection(largest)) return "";
  return source + ": the largest deflection is " + number_text(mm_from_metres(largest), 3) +
         " mm: are the units right?";
}

}  // namespace stablecut
