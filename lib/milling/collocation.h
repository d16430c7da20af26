// The cutting force collocated on the pieces of a period where it is smooth, and the structure's exact
// response to it. README.md, "Collocation".
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "milling/cut_schedule.h"
#include "milling/structure.h"

namespace stablecut::milling {

/// A Gauss point of a piece: a time in the period at which the force is a value of its own.
struct CollocationNode {
  double time_s = 0;    ///< since the period's start
  double weight_s = 0;  ///< quadrature weight over the period
  Eigen::Index first_row = 0;
  /// [directions x rows of the node], N/m2 or N s/m2: the force per depth is drive * (what the rows sense).
  Eigen::MatrixXd drive;

  Eigen::Index end_row() const { return first_row + drive.cols(); }
};

/// One number that the force at a node depends on: a displacement of the tip less the one that the surface
/// keeps from when it was cut (of one straight tooth the chip thickness), or a velocity of the tip (process
/// damping).
struct SensedRow {
  std::size_t node = 0;  ///< index of its node
  /// [directions]: the row senses direction * r, or direction * r'.
  Eigen::Matrix<double, 1, Eigen::Dynamic, Eigen::RowMajor, 1, 3> direction;
  bool is_velocity = false;
  /// The row that sensed the surface when it was cut, one delay earlier; -1 for a velocity.
  Eigen::Index cut_by = -1;
  /// Where that was in the period before: the entry of the remembered displacements u that holds it; else -1.
  Eigen::Index remembered = -1;
};

/// Where a row is a polynomial along its arc instead of a node's value: which.
struct RowPolynomial {
  std::size_t arc = 0;
  Eigen::Index degree = 0;
};

/// A piece, over which the force is smooth.
struct CollocationArc {
  std::vector<std::size_t> nodes;
  std::vector<double> place;  ///< of each node, in [-1, 1] from the arc's beginning to its end
};

/// Responses of what the rows sense (differences d) and of the modal state q, at unit depth:
///   d = E q(0) + depth W d - (what u remembers),   q(T) = Phi q(0) + depth B d.
struct Collocation {
  std::vector<CollocationNode> nodes;
  std::vector<SensedRow> rows;
  Eigen::Index remembered_count = 0;
  std::vector<CollocationArc> arcs;
  /// Where the rows are coefficients of polynomials: which, and the values at the nodes of all [sensed
  /// numbers of all nodes x rows]. Empty where a row belongs to a node.
  std::vector<RowPolynomial> polynomials;
  Eigen::MatrixXd lift;
  Eigen::MatrixXd sensed_of_state;      ///< [rows x 2 modes] E before the surface is subtracted
  Eigen::MatrixXd sensed_of_drive;      ///< [rows x rows] W before the surface is subtracted
  Eigen::MatrixXd difference_of_state;  ///< E [rows x 2 modes]
  Eigen::MatrixXd difference_of_drive;  ///< W [rows x rows]
  Eigen::MatrixXd final_of_state;       ///< Phi [2 modes x 2 modes], free flight
  Eigen::MatrixXd final_of_drive;       ///< B [2 modes x rows]
};

/// What the rows sense, at the nodes [sensed numbers of all nodes].
inline Eigen::VectorXcd at_nodes(const Collocation& c, const Eigen::VectorXcd& sensed) {
  return c.lift.size() > 0 ? Eigen::VectorXcd(c.lift * sensed) : sensed;
}

enum class Rows {
  kByNode,  ///< `points` nodes on the longest piece, fewer on shorter ones
  /// With equal pitch `points` polynomials on the longest arc, fewer on shorter ones, and as many nodes as it
  /// takes: fewer rows for the same accuracy, but dearer to make. Else as kByNode.
  kByPolynomial
};

/// `points` >= 1. Throws InvalidArgument
/// where a piece and the one that cut its surface differ in length.
Collocation collocate(const TipStructure& structure, const CutSchedule& schedule, double revolutions_per_s,
                      int points, Rows rows = Rows::kByPolynomial);

/// The radians that a mode of that frequency turns in half of the longest piece.
double half_turn_of(double rad_per_s, const CutSchedule& schedule, double revolutions_per_s);

}  // namespace stablecut::milling
