#include "document/kinds/frame_json.h"

#include <Eigen/LU>
#include <Eigen/SVD>

#include "base/units.h"
#include "document/kinds/joints_json.h"

namespace stablecut::document {
namespace {

constexpr double kRotationTolerance = 1e-6;
constexpr Bound kLength{.least = -1e6, .most = 1e6, .words = "a length in mm"};

}  // namespace

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

Json frame_to_json(const Eigen::Isometry3d& frame) {
  Json translation = Json::array(), rotation = Json::array();
  for (int i = 0; i < 3; ++i) {
    translation.push_back(mm_from_metres(frame.translation()[i]));
    rotation.push_back({frame.linear()(i, 0), frame.linear()(i, 1), frame.linear()(i, 2)});
  }
  return {{"translation_mm", std::move(translation)}, {"rotation", std::move(rotation)}};
}

}  // namespace stablecut::document
