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

// How many polynomials each arc has.
std::vector<Eigen::Index> counts_of(const Collocation& collocation, Eigen::Index most) {
  std::vector<double> lengths;
  for (const CollocationArc& arc : collocation.arcs) {
    lengths.push_back(0);
    for (const std::size_t node : arc.nodes) lengths.back() += collocation.nodes[node].weight_s;
  }
  const double longest = lengths.empty() ? 1 : *std::max_element(lengths.begin(), lengths.end());
  std::vector<Eigen::Index> counts;
  for (std::size_t a = 0; a < lengths.size(); ++a) {
    const auto share = static_cast<Eigen::Index>(
        std::ceil(lengths[a] / longest * static_cast<double>(most) - kRoundingOfShare));
    counts.push_back(std::clamp<Eigen::Index>(std::min(most, share + kShortArcPolynomials), 1,
                                              static_cast<Eigen::Index>(collocation.arcs[a].nodes.size())));
  }
  return counts;
}

}  // namespace

Eigen::VectorXd root_weights(const Collocation& collocation) {
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(static_cast<Eigen::Index>(collocation.rows.size()));
  if (!collocation.polynomials.empty()) return weights;
  for (Eigen::Index r = 0; r < weights.size(); ++r)
    weights[r] = std::sqrt(collocation.nodes[collocation.rows[r].node].weight_s);
  return weights;
}

Eigen::MatrixXd arc_polynomials(const Collocation& collocation, Eigen::Index most) {
  const std::vector<Eigen::Index> counts = counts_of(collocation, most);
  const auto rows = static_cast<Eigen::Index>(collocation.rows.size());
  Eigen::MatrixXd basis(rows, 0);
  if (!collocation.polynomials.empty()) {
    std::vector<Eigen::Index> kept;
    for (Eigen::Index r = 0; r < rows; ++r) {
      if (collocation.polynomials[r].degree < counts[collocation.polynomials[r].arc]) kept.push_back(r);
    }
    return Eigen::MatrixXd::Identity(rows, rows)(Eigen::all, kept);
  }
  for (std::size_t a = 0; a < collocation.arcs.size(); ++a) {
    const CollocationArc& arc = collocation.arcs[a];
    const auto points = static_cast<Eigen::Index>(arc.nodes.size());
    const Eigen::Index count = counts[a];
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
  // In the order of the basis: arc by arc, the polynomials of one kind of row after those of the other.
  const std::vector<Eigen::Index> counts = counts_of(c, most);
  for (std::size_t a = 0; a < c.arcs.size(); ++a) {
    const CollocationNode& node = c.nodes[c.arcs[a].nodes.front()];
    for (Eigen::Index like = node.first_row; like < node.end_row(); ++like) {
      for (Eigen::Index degree = 0; degree < counts[a]; ++degree) {
        SensedRow row = c.rows[like];
        if (!row.is_velocity) {
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
