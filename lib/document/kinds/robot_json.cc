#include "document/kinds/robot_json.h"

#include <Eigen/LU>
#include <Eigen/SVD>

#include "base/units.h"
#include "document/kinds/joints_json.h"
#include "document/text/node.h"

namespace stablecut::document {
namespace {

constexpr double kRotationTolerance = 1e-6;
constexpr Bound kAngle{.least = -1e4, .most = 1e4, .words = "an angle in degrees"};
constexpr Bound kLength{.least = -1e6, .most = 1e6, .words = "a length in mm"};

robot::Joint joint_from(const Node& node, int index) {
  node.check_names(
      {"name", "a_mm", "alpha_deg", "d_mm", "theta_sign", "theta_offset_deg", "min_deg", "max_deg"});
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
  return joint;
}

Eigen::Isometry3d frame_from(const Node& node) {
  node.check_names({"translation_mm", "rotation"});
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  frame.translation() = vector_from(node.at("translation_mm"), kLength) * 1e-3;
  const Node rotation = node.at("rotation");
  const auto rows = rotation.items();
  if (rows.size() != 3) rotation.fail("expected 3 rows");
  Eigen::Matrix3d matrix;
  for (int i = 0; i < 3; ++i) matrix.row(i) = vector_from(rows[i]).transpose();
  const double error = (matrix * matrix.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (!(error <= kRotationTolerance) || matrix.determinant() < 0) {
    rotation.fail("expected a rotation matrix: rows of length 1 at right angles, right-handed");
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(matrix, Eigen::ComputeFullU | Eigen::ComputeFullV);
  frame.linear() = svd.matrixU() * svd.matrixV().transpose();
  // The nearest rotation, unless the matrix is one already.
  if (error <= 1e-15) frame.linear() = matrix;
  return frame;
}

}  // namespace

robot::Robot robot_from_json(const Json& document, const Source& source) {
  const Node root = document_root(document, source, "robot");
  root.check_names({"format", "name", "convention", "joints", "flange", "tool", "provenance"});
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
  robot.flange = frame_from(root.at("flange"));
  robot.tool = frame_from(root.at("tool"));
  return robot;
}

}  // namespace stablecut::document
