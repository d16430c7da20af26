#include "robot/least_squares.h"

#include <Eigen/QR>
#include <limits>

namespace stablecut::robot {

Eigen::MatrixXd inverse_normal_matrix(const Eigen::MatrixXd& a) {
  const Eigen::Index n = a.cols();
  const Eigen::VectorXd per_scale = a.colwise().norm().cwiseInverse();
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(a * per_scale.asDiagonal());
  const Eigen::MatrixXd root = qr.matrixQR().topRows(n).triangularView<Eigen::Upper>();
  const Eigen::MatrixXd inverse = root.triangularView<Eigen::Upper>().solve(Eigen::MatrixXd::Identity(n, n));
  return per_scale.asDiagonal() * (inverse * inverse.transpose()) * per_scale.asDiagonal();
}

Eigen::VectorXd bounded_least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b,
                                      const std::vector<bool>& not_negative) {
  const Eigen::Index n = a.cols();
  Eigen::VectorXd best = Eigen::VectorXd::Zero(n);
  double least = std::numeric_limits<double>::infinity();
  // Bit i of `choice` is set where unknown i is free; the others are held at 0.
  for (int choice = 0; choice < 1 << n; ++choice) {
    std::vector<Eigen::Index> free;
    bool allowed = true;
    for (Eigen::Index i = 0; i < n; ++i) {
      if (choice >> i & 1)
        free.push_back(i);
      else
        allowed = allowed && not_negative[i];
    }
    if (!allowed) continue;
    const Eigen::MatrixXd part = a(Eigen::all, free);
    Eigen::VectorXd solution(part.cols());
    if (!free.empty()) {
      const Eigen::VectorXd scale = part.colwise().norm();
      solution = (part * scale.cwiseInverse().asDiagonal()).householderQr().solve(b).cwiseQuotient(scale);
    }
    for (std::size_t i = 0; i < free.size(); ++i) {
      allowed = allowed && (!not_negative[free[i]] || solution[i] >= 0);
    }
    const double sum = (part * solution - b).squaredNorm();
    if (!allowed || !(sum < least)) continue;
    least = sum;
    best.setZero();
    for (std::size_t i = 0; i < free.size(); ++i) best[free[i]] = solution[i];
  }
  return best;
}

}  // namespace stablecut::robot
