#include "robot/normal_equations.h"

#include <Eigen/Cholesky>

#include "robot/least_squares.h"

namespace stablecut::robot {
namespace {

constexpr double kOpen = 1e-10;  // of a unit column: keeps what the equations leave open at a minimum

}  // namespace

NormalEquations::NormalEquations(Eigen::MatrixXd a, Eigen::VectorXd b, std::vector<bool> not_negative)
    : a_(std::move(a)), b_(std::move(b)), not_negative_(std::move(not_negative)) {
  lengths_ = a_.colwise().norm();
  lengths_ = (lengths_.array() > 0).select(lengths_, 1.0);
  a_ *= lengths_.cwiseInverse().asDiagonal();
  matrix_.noalias() = a_.transpose() * a_;
  right_ = a_.transpose() * b_;
}

Eigen::VectorXd NormalEquations::in_unit_columns(Eigen::MatrixXd matrix, const Eigen::VectorXd& right) const {
  matrix.diagonal().array() += kOpen;
  const Eigen::LLT<Eigen::MatrixXd> factor(matrix);
  return bounded_least_squares(factor.matrixU(), factor.matrixL().solve(right),
                               {not_negative_.begin(), not_negative_.begin() + right.size()});
}

Eigen::VectorXd NormalEquations::solution(Eigen::Index count) const {
  return in_unit_columns(matrix_.topLeftCorner(count, count), right_.head(count))
      .cwiseQuotient(lengths_.head(count));
}

Eigen::VectorXd NormalEquations::residual(Eigen::Index count) const {
  return b_ - a_.leftCols(count) * in_unit_columns(matrix_.topLeftCorner(count, count), right_.head(count));
}

Eigen::VectorXd NormalEquations::left_out(Eigen::Index count,
                                          const std::vector<std::vector<Eigen::Index>>& groups) const {
  Eigen::VectorXd error = b_;
  for (const std::vector<Eigen::Index>& rows : groups) {
    const Eigen::MatrixXd part = a_(rows, Eigen::seqN(0, count));
    const Eigen::VectorXd own = b_(rows);
    error(rows) = own - part * in_unit_columns(matrix_.topLeftCorner(count, count) - part.transpose() * part,
                                               right_.head(count) - part.transpose() * own);
  }
  return error;
}

}  // namespace stablecut::robot
