#include "milling/real_pair.h"

#include <Eigen/LU>
#include <Eigen/QR>
#include <cmath>

namespace stablecut::milling {
namespace {

// Steps of inverse iteration, and the change of both numbers, of their size, at which it ends.
constexpr int kMostIterations = 20;
constexpr double kSettled = 1e-12;

Eigen::MatrixXd orthonormal(const Eigen::MatrixXd& columns) {
  return Eigen::HouseholderQR<Eigen::MatrixXd>(columns).householderQ() *
         Eigen::MatrixXd::Identity(columns.rows(), columns.cols());
}

}  // namespace

// Inverse iteration with two vectors on either side: the space of both eigenvectors is well defined where
// they themselves are not.
std::optional<RealPair> real_pair(const CircleOperator& of, const RealPair& near) {
  const Eigen::Index size = of.size();
  if (size < 2) return std::nullopt;
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(size, size);
  const Eigen::MatrixXd matrix = of.times(near.angle, one.cast<std::complex<double>>()).real();
  const Eigen::PartialPivLU<Eigen::MatrixXd> factors(matrix - near.mean * one),
      adjoint(matrix.transpose() - near.mean * one);
  Eigen::MatrixXd right(size, 2);
  for (Eigen::Index i = 0; i < size; ++i) {
    const auto turn = static_cast<double>(i);
    right.row(i) << std::cos(turn), std::cos(2 * turn + 1);
  }
  Eigen::MatrixXd left = right;
  std::optional<RealPair> last;
  for (int step = 0; step < kMostIterations; ++step) {
    right = orthonormal(factors.solve(right));
    left = orthonormal(adjoint.solve(left));
    const Eigen::Matrix2d m = (left.transpose() * right).inverse() * (left.transpose() * matrix * right);
    const double half = (m(0, 0) - m(1, 1)) / 2;
    const RealPair pair{near.angle, m.trace() / 2, half * half + m(0, 1) * m(1, 0)};
    if (!std::isfinite(pair.mean) || !std::isfinite(pair.square)) return std::nullopt;
    const double size_of_both = pair.mean * pair.mean;
    if (last && std::abs(pair.square - last->square) < kSettled * size_of_both &&
        std::abs(pair.mean - last->mean) < kSettled * std::abs(pair.mean))
      return pair;
    last = pair;
  }
  return std::nullopt;
}

}  // namespace stablecut::milling
