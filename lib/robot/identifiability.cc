#include "robot/identifiability.h"

#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>

#include "robot/least_squares.h"

namespace stablecut::robot {
namespace {

constexpr double kUnseen = 1e-3;     // of a column's largest possible size
constexpr double kDependent = 1e-6;  // of the largest singular value
constexpr double kInMixture = 1e-3;  // component of an unknown in the mixtures that nothing sees

// Judges the columns `seen` of a triangular matrix among themselves.
void judge_together(const Eigen::MatrixXd& columns, const std::vector<int>& seen, Identifiability& result) {
  const Eigen::Index count = seen.size();
  if (count == 0) return;
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(columns, Eigen::ComputeFullV);
  const Eigen::VectorXd& sigma = svd.singularValues();
  for (Eigen::Index i = 0; i < sigma.size(); ++i) result.rank += sigma[i] > kDependent * sigma[0] ? 1 : 0;
  const Eigen::MatrixXd unseen_mixtures = svd.matrixV().rightCols(count - result.rank);
  for (Eigen::Index i = 0; i < count; ++i) {
    const bool mixed = unseen_mixtures.row(i).norm() > kInMixture;
    result.visibility[seen[i]] = mixed ? Visibility::kInseparable : Visibility::kVisible;
  }
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(columns);
  for (Eigen::Index i = 0; i < result.rank; ++i)
    result.independent.push_back(seen[qr.colsPermutation().indices()[i]]);
  std::sort(result.independent.begin(), result.independent.end());
}

}  // namespace

Identifiability identifiability(const Eigen::MatrixXd& a, const Eigen::MatrixXd& largest,
                                Eigen::Index preferred) {
  Identifiability result;
  result.visibility.assign(a.cols(), Visibility::kUnseen);
  if (a.rows() == 0) return result;
  Eigen::MatrixXd root = triangular_factor(a);  // its columns have the angles between those of a
  std::vector<int> first, further;
  for (Eigen::Index j = 0; j < a.cols(); ++j) {
    const double length = root.col(j).norm();
    if (!(length > kUnseen * largest.col(j).norm())) continue;
    root.col(j) /= length;
    (j < preferred ? first : further).push_back(static_cast<int>(j));
  }
  judge_together(root(Eigen::all, first), first, result);
  std::vector<int> told_apart = first;
  std::vector<Eigen::VectorXd> basis;
  const auto left_of = [&](Eigen::VectorXd column) {
    for (int pass = 0; pass < 2; ++pass) {
      for (const Eigen::VectorXd& known : basis) column -= known.dot(column) * known;
    }
    return column;
  };
  for (const int j : result.independent) basis.push_back(left_of(root.col(j)).normalized());
  for (const int j : further) {
    const Eigen::VectorXd left = left_of(root.col(j));
    const bool of_its_own = left.norm() > kInMixture;
    result.visibility[j] = of_its_own ? Visibility::kVisible : Visibility::kInseparable;
    if (!of_its_own) continue;
    basis.push_back(left.normalized());
    result.independent.push_back(j);
    told_apart.push_back(j);
    ++result.rank;
  }
  if (result.rank > 0) {
    const Eigen::VectorXd sigma = Eigen::MatrixXd(root(Eigen::all, told_apart)).jacobiSvd().singularValues();
    result.condition_number = sigma[0] / sigma[result.rank - 1];
  }
  return result;
}

}  // namespace stablecut::robot
