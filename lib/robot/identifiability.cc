#include "robot/identifiability.h"

#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>

namespace stablecut::robot {
namespace {

constexpr double kUnseen = 1e-3;     // of a column's largest possible size
constexpr double kDependent = 1e-6;  // of the largest singular value
constexpr double kInMixture = 1e-3;  // component of a joint in the mixtures that nothing sees

}  // namespace

Identifiability identifiability(const Eigen::MatrixXd& a, const Eigen::MatrixXd& largest) {
  Identifiability result;
  result.visibility.fill(Visibility::kUnseen);
  std::vector<int> seen;
  for (int j = 0; j < kJoints; ++j) {
    if (a.rows() > 0 && a.col(j).norm() > kUnseen * largest.col(j).norm()) seen.push_back(j);
  }
  if (seen.empty()) return result;
  const Eigen::Index count = seen.size();
  Eigen::MatrixXd scaled(a.rows(), count);
  for (Eigen::Index i = 0; i < count; ++i) scaled.col(i) = a.col(seen[i]).normalized();
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(scaled, Eigen::ComputeThinU | Eigen::ComputeFullV);
  const Eigen::VectorXd& sigma = svd.singularValues();
  for (Eigen::Index i = 0; i < sigma.size(); ++i) result.rank += sigma[i] > kDependent * sigma[0] ? 1 : 0;
  result.condition_number = sigma[0] / sigma[result.rank - 1];
  const Eigen::MatrixXd unseen_mixtures = svd.matrixV().rightCols(count - result.rank);
  for (Eigen::Index i = 0; i < count; ++i) {
    const bool mixed = unseen_mixtures.row(i).norm() > kInMixture;
    result.visibility[seen[i]] = mixed ? Visibility::kInseparable : Visibility::kVisible;
  }
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(scaled);
  for (Eigen::Index i = 0; i < result.rank; ++i)
    result.independent.push_back(seen[qr.colsPermutation().indices()[i]]);
  std::sort(result.independent.begin(), result.independent.end());
  return result;
}

}  // namespace stablecut::robot
