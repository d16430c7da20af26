#include "document/kinds/robot_json.h"

#include <cmath>

#include "base/units.h"
#include "document/kinds/frame_json.h"
#include "document/kinds/joints_json.h"
#include "document/text/node.h"

namespace stablecut::document {
namespace {

constexpr Bound kAngle{.least = -1e4, .most = 1e4, .words = "an angle in degrees"};
constexpr Bound kLength{.least = -1e6, .most = 1e6, .words = "a length in mm"};
constexpr Bound kRadius{.least = 0, .most = 1e6, .open_least = true, .words = "a radius above 0 mm"};
constexpr Bound kMass{.least = 0, .most = 1e6, .words = "a mass not below 0 kg"};
constexpr Bound kSpeed{.least = 0, .most = 1e6, .open_least = true, .words = "a speed above 0 deg/s"};
constexpr Bound kRatio{.least = -100, .most = 100, .words = "a ratio"};

std::vector<robot::Capsule> capsules_from(const Node& node) {
  std::vector<robot::Capsule> capsules;
  for (const Node& item : node.items()) {
    item.check_names({"from_mm", "to_mm", "radius_mm"});
    capsules.push_back({vector_from(item.at("from_mm"), kLength) * 1e-3,
                        vector_from(item.at("to_mm"), kLength) * 1e-3,
                        metres_from_mm(item.at("radius_mm").number(kRadius))});
  }
  return capsules;
}

void read_link(const Node& node, robot::Joint& joint) {
  const auto mass = node.find("mass_kg"), center = node.find("center_mm");
  if (mass && !center) node.fail("expected center_mm with mass_kg");
  if (center && !mass) node.fail("expected mass_kg with center_mm");
  if (mass) joint.mass = {mass->number(kMass), vector_from(*center, kLength) * 1e-3};
  if (const auto capsules = node.find("capsules")) joint.capsules = capsules_from(*capsules);
}

robot::Joint joint_from(const Node& node, int index) {
  node.check_names({"name", "a_mm", "alpha_deg", "d_mm", "theta_sign", "theta_offset_deg", "min_deg",
                    "max_deg", "coupled_min_deg", "coupled_max_deg", "max_speed_deg_per_s", "mass_kg",
                    "center_mm", "capsules"});
  robot::Joint joint;
  joint.name = "A" + std::to_string(index + 1);
  if (const auto name = node.find("name")) joint.name = name->text();
  joint.a_m = metres_from_mm(node.at("a_mm").number(kLength));
  joint.set_alpha(radians_from_degrees(node.at("alpha_deg").number(kAngle)));
  joint.d_m = metres_from_mm(node.at("d_mm").number(kLength));
  joint.theta_sign = node.at("theta_sign").number();
  if (joint.theta_sign != 1 && joint.theta_sign != -1) node.at("theta_sign").fail("expected 1 or -1");
  joint.theta_offset_rad = radians_from_degrees(node.at("theta_offset_deg").number(kAngle));
  joint.min_rad = radians_from_degrees(node.at("min_deg").number(kAngle));
  joint.max_rad = radians_from_degrees(node.at("max_deg").number(kAngle));
  if (!(joint.min_rad < joint.max_rad)) node.at("max_deg").fail("expected an angle above min_deg");
  if (const auto least = node.find("coupled_min_deg"))
    joint.coupled_min_rad = radians_from_degrees(least->number(kAngle));
  if (const auto most = node.find("coupled_max_deg")) {
    joint.coupled_max_rad = radians_from_degrees(most->number(kAngle));
    if (!(joint.coupled_min_rad < joint.coupled_max_rad))
      most->fail("expected an angle above coupled_min_deg");
  }
  if (const auto speed = node.find("max_speed_deg_per_s"))
    joint.max_speed = radians_from_degrees(speed->number(kSpeed));
  read_link(node, joint);
  return joint;
}

// Index of the joint that `node` names, of the first `count`.
int joint_named(const Node& node, const robot::Robot& robot, int count) {
  std::string names;
  for (int j = 0; j < count; ++j) {
    if (robot.joints[j].name == node.text()) return j;
    names += (j > 0 ? ", " : "") + robot.joints[j].name;
  }
  node.fail("expected one of " + names);
}

void read_coupling(const Node& node, robot::Robot& robot) {
  for (const Node& item : node.items()) {
    item.check_names({"joint", "follows", "ratio"});
    const int index = joint_named(item.at("joint"), robot, robot::kJoints);
    robot::Joint& joint = robot.joints[index];
    if (index == 0) item.at("joint").fail("expected a joint after the first");
    if (joint.coupling) item.at("joint").fail("expected each joint once");
    const int follows = joint_named(item.at("follows"), robot, index);
    const double ratio = item.at("ratio").number(kRatio);
    // Else the copies of the followed angle by whole turns would lead to different angles of this joint.
    const bool turns_over = robot.joints[follows].max_rad - robot.joints[follows].min_rad > kTwoPi;
    if (turns_over && ratio != std::nearbyint(ratio)) {
      item.at("ratio").fail("expected a whole number, since " + robot.joints[follows].name +
                            " has more than a full turn");
    }
    joint.coupling = {follows, ratio};
  }
}

// A bound of a coupled range without a coupling would bound nothing.
void check_coupled_ranges(const Node& joint_node, const robot::Joint& joint) {
  if (joint.coupling) return;
  for (const char* name : {"coupled_min_deg", "coupled_max_deg"}) {
    if (const auto bound = joint_node.find(name))
      bound->fail("expected with an entry for " + joint.name + " in coupling only");
  }
}

}  // namespace

robot::Robot robot_from_json(const Json& document, const Source& source) {
  const Node root = document_root(document, source, "robot");
  root.check_document_names({"name", "convention", "joints", "flange", "tool", "base", "coupling",
                             "base_capsules", "keep_out_radius_mm"});
  root.at("convention").word({"modified-dh"});
  robot::Robot robot;
  if (const auto name = root.find("name")) name->text();
  const Node joints = root.at("joints");
  const auto items = joints.items();
  if (items.size() != robot::kJoints) joints.fail("expected 6 joints");
  for (int j = 0; j < robot::kJoints; ++j) {
    robot.joints[j] = joint_from(items[j], j);
    for (int i = 0; i < j; ++i) {
      if (robot.joints[i].name == robot.joints[j].name)
        items[j].at("name").fail("expected names that differ");
    }
  }
  if (const auto coupling = root.find("coupling")) read_coupling(*coupling, robot);
  for (int j = 0; j < robot::kJoints; ++j) check_coupled_ranges(items[j], robot.joints[j]);
  if (const auto base = root.find("base")) robot.base = frame_from(*base);
  if (const auto capsules = root.find("base_capsules")) robot.base_capsules = capsules_from(*capsules);
  if (const auto radius = root.find("keep_out_radius_mm"))
    robot.keep_out_radius_m = metres_from_mm(radius->number(kRadius));
  robot.flange = frame_from(root.at("flange"));
  robot.tool = frame_from(root.at("tool"));
  return robot;
}

}  // namespace stablecut::document
