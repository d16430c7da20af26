#include "milling/circle_operator.h"

#include "milling/arc_polynomials.h"

namespace stablecut::milling {
CircleOperator circle_operator(const TipStructure& structure, const Collocation& c, double period_s) {
  const auto rows = static_cast<Eigen::Index>(c.rows.size());
  const Eigen::VectorXd weight = root_weights(c), inverse = weight.cwiseInverse();
  CircleOperator result;
  result.direct = weight.asDiagonal() * c.difference_of_drive * inverse.asDiagonal();
  result.of_state = weight.asDiagonal() * c.difference_of_state;
  result.direct_before = Eigen::MatrixXd::Zero(rows, rows);
  result.of_state_before = Eigen::MatrixXd::Zero(rows, c.sensed_of_state.cols());
  result.plain = true;
  for (Eigen::Index r = 0; r < rows; ++r) {
    const SensedRow& row = c.rows[r];
    result.plain = result.plain && row.cut_by == r && row.remembered >= 0;
    if (row.remembered < 0) continue;
    result.direct_before.row(r) =
        -weight[r] * c.sensed_of_drive.row(row.cut_by).cwiseProduct(inverse.transpose());
    result.of_state_before.row(r) = -weight[r] * c.sensed_of_state.row(row.cut_by);
  }
  result.state_of = c.final_of_drive * inverse.asDiagonal();
  result.growth = (structure.lambda * period_s).array().exp();
  return result;
}

CircleOperator projected(const CircleOperator& whole, const Eigen::MatrixXd& basis) {
  CircleOperator result;
  result.direct = basis.transpose() * whole.direct * basis;
  result.of_state = basis.transpose() * whole.of_state;
  result.state_of = whole.state_of * basis;
  result.growth = whole.growth;
  result.plain = whole.plain;
  if (whole.plain) {
    result.direct_before = -result.direct;
    result.of_state_before = -result.of_state;
  } else {
    result.direct_before = basis.transpose() * whole.direct_before * basis;
    result.of_state_before = basis.transpose() * whole.of_state_before;
  }
  return result;
}

}  // namespace stablecut::milling
