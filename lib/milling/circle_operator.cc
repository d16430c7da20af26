#include "milling/circle_operator.h"

#include "milling/arc_polynomials.h"

namespace stablecut::milling {

CircleOperator circle_operator(const TipStructure& structure, const Collocation& c, double period_s) {
  const auto rows = static_cast<Eigen::Index>(c.rows.size());
  const Eigen::VectorXd weight = root_weights(c), inverse = weight.cwiseInverse();
  CircleOperator result;
  result.direct = weight.asDiagonal() * c.difference_of_drive * inverse.asDiagonal();
  result.of_state = weight.asDiagonal() * c.difference_of_state;
  result.state_of = c.final_of_drive * inverse.asDiagonal();
  result.growth = (structure.lambda * period_s).array().exp();
  bool plain = true;
  for (Eigen::Index r = 0; r < rows; ++r) plain = plain && c.rows[r].cut_by == r && c.rows[r].remembered >= 0;
  if (plain) return result;
  result.direct_before = Eigen::MatrixXd::Zero(rows, rows);
  result.of_state_before = Eigen::MatrixXd::Zero(rows, c.sensed_of_state.cols());
  for (Eigen::Index r = 0; r < rows; ++r) {
    if (c.rows[r].remembered < 0) continue;
    const Eigen::Index cutting = c.rows[r].cut_by;
    result.direct_before.row(r) =
        -weight[r] * c.sensed_of_drive.row(cutting).cwiseProduct(inverse.transpose());
    result.of_state_before.row(r) = -weight[r] * c.sensed_of_state.row(cutting);
  }
  return result;
}

CircleOperator projected(const CircleOperator& whole, const Eigen::MatrixXd& basis) {
  CircleOperator result;
  result.direct = basis.transpose() * whole.direct * basis;
  result.of_state = basis.transpose() * whole.of_state;
  result.state_of = whole.state_of * basis;
  result.growth = whole.growth;
  if (whole.plain()) return result;
  result.direct_before = basis.transpose() * whole.direct_before * basis;
  result.of_state_before = basis.transpose() * whole.of_state_before;
  return result;
}

}  // namespace stablecut::milling
