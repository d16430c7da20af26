#include "document/kinds/joints_json.h"

#include <cmath>

#include "base/units.h"

namespace stablecut::document {
namespace {

constexpr Bound kJointAngle{.least = -1e4, .most = 1e4, .words = "a joint angle in degrees"};

}  // namespace

Eigen::Vector3d vector_from(const Node& node, const Bound& bound) {
  const Eigen::VectorXd numbers = node.numbers(bound);
  if (numbers.size() != 3) node.fail("expected 3 numbers");
  return numbers;
}

robot::JointAngles joint_angles_from(const Node& node) {
  const Eigen::VectorXd degrees = node.numbers(kJointAngle);
  if (degrees.size() != robot::kJoints) node.fail("expected 6 joint angles in degrees");
  return degrees * radians_from_degrees(1);
}

Json joint_angles_to_json(const robot::JointAngles& angles) {
  Json list = Json::array();
  for (const double angle : angles) list.push_back(document_degrees(angle));
  return list;
}

double document_degrees(double rad) { return std::round(degrees_from_radians(rad) * 1e12) / 1e12; }

Json number_or_null(std::optional<double> value) {
  return value && std::isfinite(*value) ? Json(*value) : Json(nullptr);
}

}  // namespace stablecut::document
