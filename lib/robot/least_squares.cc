#include "robot/least_squares.h"

#include <Eigen/QR>
#include <algorithm>

namespace stablecut::robot {
namespace {

constexpr double kAtRest = 1e-13;          // slope of a unit column against the right side: below, rounding
constexpr Eigen::Index kRowsAtOnce = 512;  // with twenty columns 80 KiB: the second cache
constexpr int kMostChangesEach = 100;      // of the set, for each unknown: a guard

Eigen::VectorXd lengths(const Eigen::MatrixXd& a) {
  const Eigen::VectorXd norms = a.colwise().norm();
  return (norms.array() > 0).select(norms, 1.0);
}

// The minimum over the unknowns in `free`, the others at 0.
Eigen::VectorXd minimum(const Eigen::MatrixXd& a, const Eigen::VectorXd& b, const std::vector<bool>& free) {
  std::vector<Eigen::Index> columns;
  for (std::size_t i = 0; i < free.size(); ++i) {
    if (free[i]) columns.push_back(static_cast<Eigen::Index>(i));
  }
  Eigen::VectorXd x = Eigen::VectorXd::Zero(a.cols());
  if (columns.empty()) return x;
  x(columns) = Eigen::MatrixXd(a(Eigen::all, columns)).householderQr().solve(b);
  return x;
}

}  // namespace

Eigen::MatrixXd triangular_factor(const Eigen::MatrixXd& a) {
  // Block by block, each with the factor of the rows before on top, so that all stays in the cache.
  const Eigen::Index n = a.cols();
  const Eigen::VectorXd scale = lengths(a);
  Eigen::MatrixXd root = Eigen::MatrixXd::Zero(n, n), block;
  for (Eigen::Index first = 0; first < a.rows(); first += kRowsAtOnce) {
    const Eigen::Index rows = std::min(kRowsAtOnce, a.rows() - first);
    block.resize(n + rows, n);
    block.topRows(n) = root;
    block.bottomRows(rows) = a.middleRows(first, rows) * scale.cwiseInverse().asDiagonal();
    const Eigen::HouseholderQR<Eigen::Ref<Eigen::MatrixXd>> qr(block);  // in place
    root = block.topRows(n).triangularView<Eigen::Upper>();
  }
  return root * scale.asDiagonal();
}

Eigen::MatrixXd inverse_normal_matrix(const Eigen::MatrixXd& a) {
  const Eigen::Index n = a.cols();
  const Eigen::VectorXd per_scale = lengths(a).cwiseInverse();
  const Eigen::MatrixXd root = triangular_factor(a) * per_scale.asDiagonal();
  const Eigen::MatrixXd inverse = root.triangularView<Eigen::Upper>().solve(Eigen::MatrixXd::Identity(n, n));
  return per_scale.asDiagonal() * (inverse * inverse.transpose()) * per_scale.asDiagonal();
}

Eigen::VectorXd bounded_least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b,
                                      const std::vector<bool>& not_negative) {
  const Eigen::Index n = a.cols();
  Eigen::MatrixXd both(a.rows(), n + 1);
  both << a, b;
  const Eigen::MatrixXd root = triangular_factor(both);  // the same problem in n + 1 rows
  const Eigen::VectorXd scale = lengths(a);
  const Eigen::MatrixXd unit = root.leftCols(n) * scale.cwiseInverse().asDiagonal();
  const Eigen::VectorXd right = root.col(n);
  std::vector<bool> free(n);
  for (Eigen::Index i = 0; i < n; ++i) free[i] = !not_negative[i];
  Eigen::VectorXd x = minimum(unit, right, free);
  for (int change = 0; change < kMostChangesEach * n; ++change) {
    // The unknown at 0 that gains most by growing.
    const Eigen::VectorXd slope = unit.transpose() * (right - unit * x);
    Eigen::Index next = -1;
    for (Eigen::Index i = 0; i < n; ++i) {
      if (!free[i] && slope[i] > kAtRest * right.norm() && (next < 0 || slope[i] > slope[next])) next = i;
    }
    if (next < 0) break;
    free[next] = true;
    Eigen::VectorXd target = minimum(unit, right, free);
    if (!(target[next] > 0)) {  // it gained by rounding alone
      free[next] = false;
      break;
    }
    // As far towards the minimum as the signs allow; what reaches 0 stays there.
    for (;;) {
      double step = 1;
      Eigen::Index first = -1;
      for (Eigen::Index i = 0; i < n; ++i) {
        if (!free[i] || !not_negative[i] || target[i] > 0) continue;
        const double to_zero = x[i] > 0 ? x[i] / (x[i] - target[i]) : 0;
        if (to_zero < step) {
          step = to_zero;
          first = i;
        }
      }
      x += step * (target - x);
      if (first < 0) break;
      x[first] = 0;
      free[first] = false;
      target = minimum(unit, right, free);
    }
  }
  return x.cwiseQuotient(scale);
}

}  // namespace stablecut::robot
