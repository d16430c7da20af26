#include "milling/arc_polynomials.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "numerics/legendre.h"

namespace stablecut::milling {
namespace {

// Polynomials that a short arc has beside its share of the longest one's, and what is kept off that share
// before it is rounded up, so that arcs of one length have equally many.
constexpr int kShortArcPolynomials = 5;
constexpr double kRoundingOfShare = 1e-6;

}  // namespace

Eigen::VectorXd root_weights(const Collocation& collocation) {
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(static_cast<Eigen::Index>(collocation.rows.size()));
  if (!collocation.polynomials.empty()) return weights;
  for (Eigen::Index r = 0; r < weights.size(); ++r)
    weights[r] = std::sqrt(collocation.nodes[collocation.rows[r].node].weight_s);
  return weights;
}

Eigen::MatrixXd arc_polynomials(const Collocation& collocation, Eigen::Index most) {
  const auto length = [&](const CollocationArc& arc) {
    double sum = 0;
    for (const std::size_t node : arc.nodes) sum += collocation.nodes[node].weight_s;
    return sum;
  };
  double longest = 0;
  for (const CollocationArc& arc : collocation.arcs) longest = std::max(longest, length(arc));
  const auto count_on = [&](const CollocationArc& arc) {
    const auto share = static_cast<Eigen::Index>(
        std::ceil(length(arc) / longest * static_cast<double>(most) - kRoundingOfShare));
    return std::clamp<Eigen::Index>(std::min(most, share + kShortArcPolynomials), 1,
                                    static_cast<Eigen::Index>(arc.nodes.size()));
  };
  const auto rows = static_cast<Eigen::Index>(collocation.rows.size());
  Eigen::MatrixXd basis(rows, 0);
  if (!collocation.polynomials.empty()) {
    std::vector<Eigen::Index> kept;
    for (Eigen::Index r = 0; r < rows; ++r) {
      if (collocation.polynomials[r].degree < count_on(collocation.arcs[collocation.polynomials[r].arc]))
        kept.push_back(r);
    }
    return Eigen::MatrixXd::Identity(rows, rows)(Eigen::all, kept);
  }
  for (const CollocationArc& arc : collocation.arcs) {
    const auto points = static_cast<Eigen::Index>(arc.nodes.size());
    const Eigen::Index count = count_on(arc);
    Eigen::MatrixXd values(points, count);
    for (Eigen::Index i = 0; i < points; ++i)
      values.row(i) = std::sqrt(collocation.nodes[arc.nodes[i]].weight_s) *
                      numerics::legendre_values(arc.place[i], count).transpose();
    // Along one piece they are orthogonal already.
    Eigen::MatrixXd orthonormal = values;
    if (arc.pieces == 1)
      orthonormal.colwise().normalize();
    else
      orthonormal = Eigen::HouseholderQR<Eigen::MatrixXd>(values).householderQ() *
                    Eigen::MatrixXd::Identity(points, count);
    const Eigen::Index kinds = collocation.nodes[arc.nodes.front()].drive.cols();
    const Eigen::Index before = basis.cols();
    basis.conservativeResize(Eigen::NoChange, before + kinds * count);
    basis.rightCols(kinds * count).setZero();
    for (Eigen::Index i = 0; i < points; ++i)
      for (Eigen::Index kind = 0; kind < kinds; ++kind)
        basis.block(collocation.nodes[arc.nodes[i]].first_row + kind, before + kind * count, 1, count) =
            orthonormal.row(i);
  }
  return basis;
}

// The same with polynomials along the arcs in the place of the nodes' values: of every piece that was cut by
// itself one period earlier.
Collocation along_arcs(const Collocation& c, Eigen::Index most) {
  const Eigen::MatrixXd basis = arc_polynomials(c, most);
  Eigen::VectorXd weight = root_weights(c);
  weight /= weight.norm();  // so that coefficients are of the size of what is sensed
  const Eigen::MatrixXd to = basis.transpose() * weight.asDiagonal();
  Collocation result;
  result.nodes = c.nodes;
  result.arcs = c.arcs;
  result.lift = weight.cwiseInverse().asDiagonal() * basis;
  result.final_of_state = c.final_of_state;
  result.final_of_drive = c.final_of_drive * result.lift;
  result.difference_of_state = to * c.difference_of_state;
  result.difference_of_drive = to * c.difference_of_drive * result.lift;
  result.sensed_of_state = result.difference_of_state;
  result.sensed_of_drive = result.difference_of_drive;
  for (std::size_t a = 0; a < c.arcs.size(); ++a) {
    const CollocationNode& node = c.nodes[c.arcs[a].nodes.front()];
    // Columns of one kind of row follow each other.
    for (Eigen::Index r = node.first_row; r < node.end_row(); ++r) {
      const SensedRow& like = c.rows[r];
      for (Eigen::Index degree = 0;
           static_cast<Eigen::Index>(result.rows.size()) < basis.cols() &&
           !basis.block(r, static_cast<Eigen::Index>(result.rows.size()), 1, 1).isZero(0);
           ++degree) {
        SensedRow row = like;
        if (!like.is_velocity) {
          row.cut_by = static_cast<Eigen::Index>(result.rows.size());
          row.remembered = result.remembered_count++;
        }
        result.rows.push_back(row);
        result.polynomials.push_back({a, degree});
      }
    }
  }
  return result;
}

}  // namespace stablecut::milling
