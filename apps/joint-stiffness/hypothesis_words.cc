#include "hypothesis_words.h"

#include "base/number_text.h"
#include "base/units.h"
#include "cli/exit_status.h"
#include "cli/tool.h"
#include "document/kinds/hypothesis_json.h"

namespace stablecut {
namespace {

using Kind = robot::Hypothesis::Kind;

std::string vector_text(const Eigen::Vector3d& vector) {
  return number_text(vector[0], 3) + ", " + number_text(vector[1], 3) + ", " + number_text(vector[2], 3);
}

// "with ...", what the change is.
std::string change_text(const robot::Hypothesis& hypothesis, const robot::Robot& robot) {
  const std::string& joint = robot.joints[hypothesis.joint].name;
  switch (hypothesis.kind) {
    case Kind::kSign:
      return "the sign of " + joint + " turned";
    case Kind::kCoupling: {
      if (hypothesis.ratio == 0) return joint + " not coupled to " + robot.joints[hypothesis.follows].name;
      return joint + " coupled to " + robot.joints[hypothesis.follows].name + " by " +
             number_text(hypothesis.ratio, 3);
    }
    case Kind::kTurned: {
      Eigen::Index axis = 0;
      hypothesis.vector.cwiseAbs().maxCoeff(&axis);
      return "the deflections turned by " + number_text(degrees_from_radians(hypothesis.vector[axis]), 3) +
             " degrees about " + "xyz"[axis] + " of the base frame";
    }
    case Kind::kRotated:
      return "the deflections turned by " + vector_text(hypothesis.vector * (180 / kPi)) +
             " degrees about x, y, z (a rotation vector)";
    case Kind::kRadians:
      return "the angles taken as radians";
    case Kind::kLoadPoint:
      return "the load " + vector_text(hypothesis.vector * 1e3) + " mm beside its point (flange frame)";
    case Kind::kOwnWeight:
      return "the robot's own weight, as of deflections from where it would be without,";
    case Kind::kLength:
      return "the link before " + joint + " longer by " + number_text(hypothesis.vector[0] * 1e3, 3) + " mm";
    case Kind::kNone:
    case Kind::kDeflectionUnit:
    case Kind::kForceUnit:
      break;
  }
  return "";
}

std::string stiffness_text(const robot::StiffnessOfReach& stiffness, const robot::Robot& robot,
                           const document::LoadSamplesDocument& samples) {
  const bool soft = *stiffness.ratio < 1;
  std::string text = "the arm is " + number_text(soft ? 1 / *stiffness.ratio : *stiffness.ratio, 3) +
                     " times " + (soft ? "softer" : "stiffer") + " than robots of " +
                     number_text(stiffness.reach_m, 3) + " m reach usually are";
  if (!stiffness.unit) return text + ": are the units right?";
  const std::string name = document::hypothesis_name(*stiffness.unit, robot, samples);
  return text + ": are " + (stiffness.unit->kind == Kind::kForceUnit ? "the forces" : "the deflections") +
         " in " + name.substr(name.find(':') + 1) + "? --apply " + name;
}

}  // namespace

std::vector<robot::Hypothesis> apply_named(const std::vector<std::string>& names, robot::Robot& robot,
                                           document::LoadSamplesDocument& samples,
                                           const std::array<bool, 3>& components) {
  std::vector<robot::Hypothesis> applied;
  for (const std::string& name : names) {
    const robot::HypothesisOptions options = document::hypothesis_options(samples, components);
    std::optional<robot::Hypothesis> named;
    std::string known;
    for (const robot::Hypothesis& hypothesis : robot::hypotheses(robot, samples.samples, options)) {
      const std::string own = document::hypothesis_name(hypothesis, robot, samples);
      known += (known.empty() ? "" : ", ") + own;
      if (own == name) named = hypothesis;
    }
    if (!named) throw cli::WrongUsage("--apply: " + name + ": expected one of " + known);
    applied.push_back(robot::fitted(*named, robot, samples.samples, options));
    robot::apply(applied.back(), robot, samples.samples);
  }
  return applied;
}

SecondLook second_look(const robot::Robot& robot, const document::LoadSamplesDocument& samples,
                       const std::array<bool, 3>& components) {
  const robot::HypothesisOptions options = document::hypothesis_options(samples, components);
  SecondLook look{robot::better_fits(robot, samples.samples, options), {}};
  robot::Robot changed = robot;
  std::vector<robot::LoadSample> changed_samples = samples.samples;
  if (!look.better.empty()) robot::apply(look.better.front().hypothesis, changed, changed_samples);
  look.stiffness = robot::stiffness_of_reach(changed, changed_samples, options);
  return look;
}

std::vector<std::string> hypothesis_warnings(const SecondLook& look, const robot::Robot& robot,
                                             const document::LoadSamplesDocument& samples) {
  std::vector<std::string> warnings;
  for (const robot::BetterFit& fit : look.better) {
    warnings.push_back(
        "with " + change_text(fit.hypothesis, robot) + " the residual falls from " +
        number_text(fit.residual_before_m * 1e6, 3) + " to " + number_text(fit.residual_after_m * 1e6, 3) +
        " um (" + std::to_string(fit.poses_better) + " poses of " + std::to_string(fit.poses) +
        " agree better): --apply " + document::hypothesis_name(fit.hypothesis, robot, samples));
  }
  if (!look.stiffness.usual) warnings.push_back(stiffness_text(look.stiffness, robot, samples));
  return warnings;
}

std::string misfit_warning(const robot::Identification& found) {
  if (!robot::misfit(found.residual_rms_m, found.deflection_rms_m)) return "";
  return "the residual of " + number_text(found.residual_rms_m * 1e6, 3) +
         " um is large beside the deflection of " + number_text(found.deflection_rms_m * 1e6, 3) +
         " um: predicted deflections may be off by half";
}

}  // namespace stablecut
