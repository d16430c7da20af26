#include "milling/arc_polynomials.h"

#include <algorithm>
#include <cmath>

#include "numerics/legendre.h"

namespace stablecut::milling {
namespace {

// Polynomials that a short arc has beside its share of the longest one's, and what is kept off that share
// before it is rounded up, so that arcs of one length have equally many.
constexpr int kShortArcPolynomials = 5;
constexpr double kRoundingOfShare = 1e-6;

// [rows] Square root of the quadrature weight of each row's node: what is sensed times this has the
// integral's norm.
Eigen::VectorXd root_weights(const Collocation& collocation) {
  Eigen::VectorXd weights(static_cast<Eigen::Index>(collocation.rows.size()));
  for (Eigen::Index r = 0; r < weights.size(); ++r)
    weights[r] = std::sqrt(collocation.nodes[collocation.rows[r].node].weight_s);
  return weights;
}

// [rows x columns] Orthonormal columns: polynomials along each arc.
Eigen::MatrixXd basis_of(const Collocation& collocation, const std::vector<Eigen::Index>& counts) {
  Eigen::MatrixXd basis(static_cast<Eigen::Index>(collocation.rows.size()), 0);
  for (std::size_t a = 0; a < collocation.arcs.size(); ++a) {
    const CollocationArc& arc = collocation.arcs[a];
    const auto points = static_cast<Eigen::Index>(arc.nodes.size());
    const Eigen::Index count = counts[a];
    Eigen::MatrixXd values(points, count);
    for (Eigen::Index i = 0; i < points; ++i)
      values.row(i) = std::sqrt(collocation.nodes[arc.nodes[i]].weight_s) *
                      numerics::legendre_values(arc.place[i], count).transpose();
    values.colwise().normalize();
    const Eigen::Index kinds = collocation.nodes[arc.nodes.front()].drive.cols();
    const Eigen::Index before = basis.cols();
    basis.conservativeResize(Eigen::NoChange, before + kinds * count);
    basis.rightCols(kinds * count).setZero();
    for (Eigen::Index i = 0; i < points; ++i)
      for (Eigen::Index kind = 0; kind < kinds; ++kind)
        basis.block(collocation.nodes[arc.nodes[i]].first_row + kind, before + kind * count, 1, count) =
            values.row(i);
  }
  return basis;
}

}  // namespace

std::vector<Eigen::Index> polynomials_on(const std::vector<double>& arc_length, Eigen::Index most) {
  const double longest = arc_length.empty() ? 1 : *std::max_element(arc_length.begin(), arc_length.end());
  std::vector<Eigen::Index> counts;
  for (const double length : arc_length) {
    const auto share =
        static_cast<Eigen::Index>(std::ceil(length / longest * static_cast<double>(most) - kRoundingOfShare));
    counts.push_back(std::max<Eigen::Index>(std::min(most, share + kShortArcPolynomials), 1));
  }
  return counts;
}

std::vector<double> arc_lengths(const Collocation& collocation) {
  std::vector<double> lengths;
  for (const CollocationArc& arc : collocation.arcs) {
    lengths.push_back(0);
    for (const std::size_t node : arc.nodes) lengths.back() += collocation.nodes[node].weight_s;
  }
  return lengths;
}

Collocation along_arcs(const Collocation& c, Eigen::Index most) {
  const std::vector<Eigen::Index> counts = polynomials_on(arc_lengths(c), most);
  const Eigen::MatrixXd basis = basis_of(c, counts);
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
