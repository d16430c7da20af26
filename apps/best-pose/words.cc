#include "words.h"

#include "base/number_text.h"
#include "base/units.h"
#include "document/kinds/joint_stiffness_json.h"

namespace stablecut {
namespace {

std::string degrees_text(double rad) { return number_text(degrees_from_radians(rad), 3) + " degrees"; }

const char* expected_text(robot::GeometryRule rule) {
  switch (rule) {
    case robot::GeometryRule::kShoulderNotParallel:
      return "no multiple of 180, since axes 1 and 2 must not be parallel";
    case robot::GeometryRule::kElbowParallel:
      return "0 or 180, since the axes of shoulder and elbow have to be parallel";
    case robot::GeometryRule::kUpperArm:
      return "an upper arm longer than 0";
    case robot::GeometryRule::kForearm:
      return "a forearm longer than 0";
    case robot::GeometryRule::kWristCentre:
      return "0, since axes 4, 5 and 6 have to meet in one point (a spherical wrist)";
    case robot::GeometryRule::kWristSquare:
      return "90 or -90, since the axes of the wrist have to cross at right angles";
  }
  return "";
}

}  // namespace

std::string index_names() {
  std::string names;
  for (const robot::StiffnessIndex& index : robot::stiffness_indices()) {
    names += (names.empty() ? "" : "|") + std::string(index.name);
  }
  return names;
}

std::string index_help() {
  std::string text = "What counts as stiff:";
  const char* separator = " ";
  for (const robot::StiffnessIndex& index : robot::stiffness_indices()) {
    text += separator + std::string(index.name) + " = " + index.meaning;
    separator = "; ";
  }
  return text + " (default: " + robot::stiffness_indices().front().name + ")";
}

std::string no_pose_text(const robot::Obstacle& obstacle, const robot::Robot& robot) {
  const std::string text = "no reachable pose: ";
  const double margin = obstacle.margin_rad;
  switch (obstacle.kind) {
    case robot::Obstacle::Kind::kOutOfReach:
      return text + "nothing of the plane is within the arm's reach with this tool axis";
    case robot::Obstacle::Kind::kSingularity:
      return text +
             "all poses within the joint limits are nearer to a singularity than the singularity margin";
    case robot::Obstacle::Kind::kKeepOut:
      return text + "all poses within the joint limits bring tool or links into what they keep out of";
    case robot::Obstacle::Kind::kJointLimit:
      break;
  }
  return text + "at best joint " + robot.joints[obstacle.joint].name + " would be " +
         (margin < 0 ? degrees_text(-margin) + " outside its limits"
                     : degrees_text(margin) + " from a limit, nearer than the limit margin");
}

std::string metres_text(const SearchOptions& where, const robot::Robot& robot) {
  if (!height_may_be_metres(where, robot)) return "";
  const std::string height = number_text(*where.height_mm);
  return "--height: " + height + ": taken as " + height + " mm; a plane at " + height +
         " m would be within reach too";
}

document::DataError unsupported_robot(const robot::UnsupportedGeometry& bad, const robot::Robot& robot,
                                      const document::Source& source) {
  const robot::Joint& joint = robot.joints[bad.joint];
  std::string field;
  double value = 0;
  switch (bad.parameter) {
    case robot::DhParameter::kA:
      field = "a_mm";
      value = mm_from_metres(joint.a_m);
      break;
    case robot::DhParameter::kAlpha:
      field = "alpha_deg";
      value = degrees_from_radians(joint.alpha_rad());
      break;
    case robot::DhParameter::kD:
      field = "d_mm";
      value = mm_from_metres(joint.d_m);
      break;
  }
  return document::DataError(source.name, "/joints/" + std::to_string(bad.joint) + "/" + field,
                             number_text(value),
                             std::string("expected ") + expected_text(bad.rule) +
                                 ": a search needs its inverse kinematics (--evaluate does not)");
}

std::string rigid_springs_text(const robot::JointStiffness& joints, const robot::Robot& robot) {
  std::string names;
  for (std::size_t i = 0; i < joints.others.size(); ++i) {
    if (!joints.other_compliance[i])
      names += (names.empty() ? "" : ", ") + document::spring_name(joints.others[i], robot);
  }
  return names.empty() ? "" : "/springs: " + names + ": not identified: taken as rigid";
}

std::string untold_score_text(const robot::PoseReport& report, const robot::StiffnessIndex& index) {
  if (!report.score_std || !(*report.score_std > report.score)) return "";
  return "the score " + number_text(report.score * index.units_per_score, 3) + " " + index.unit +
         " is smaller than its own standard deviation, " +
         number_text(*report.score_std * index.units_per_score, 3) +
         ": the joint stiffness does not tell how stiff this is";
}

std::string idle_redundancy_text(const robot::Robot& robot, const robot::StiffnessIndex& index) {
  return "--redundancy: the tool is coaxial with joint " + robot.joints.back().name +
         ", which alone turns it: no redundancy angle can change the index " + index.name;
}

}  // namespace stablecut
