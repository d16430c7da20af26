// The cutting force of one period as an operator on the unit circle. README.md, "Limits from the unit
// circle".
#pragma once

#include <Eigen/Core>
#include <complex>
#include <vector>

#include "milling/collocation.h"
#include "milling/structure.h"

namespace stablecut::milling {

/// What a period's force says of motions that are multiplied by mu over the period: the differences d that it
/// depends on obey d = depth * M(mu) d,
///   M(mu) = sum over the parts of mu^-delay (V + U G(mu) B),   G(mu) = (mu - free flight)^-1,
/// so that a depth is one with multiplier mu exactly when 1 / depth is an eigenvalue of M(mu). Where `plain`,
/// every surface was cut one period earlier, and M is 1 - 1 / mu times its one part. In a basis of the
/// differences' space that is orthonormal for integrals over the period.
struct CircleOperator {
  struct Part {
    int delay = 0;             ///< periods
    Eigen::MatrixXd direct;    ///< V [size x size]
    Eigen::MatrixXd of_state;  ///< U [size x 2 modes]; no columns: 0
  };
  std::vector<Part> parts;   ///< at least one
  Eigen::MatrixXd state_of;  ///< B [2 modes x size]
  Eigen::VectorXcd growth;   ///< [modes] what free flight multiplies each mode by
  bool plain = false;
  std::vector<RowPolynomial> polynomials;  ///< [size] which each row is the coefficient of
  std::vector<double> arc_length;          ///< [arcs], to a factor

  Eigen::Index size() const { return state_of.cols(); }
  /// Polynomials on the longest arc.
  Eigen::Index most() const;
  /// The rows whose degree is one that `most` polynomials on the longest arc leave.
  std::vector<Eigen::Index> rows_of(Eigen::Index most) const;

  /// M(exp(i angle)).
  Eigen::MatrixXcd matrix(double angle) const;
  /// M(exp(i angle)) times each column, and its adjoint times each.
  Eigen::MatrixXcd times(double angle, const Eigen::MatrixXcd& columns) const;
  Eigen::MatrixXcd adjoint_times(double angle, const Eigen::MatrixXcd& columns) const;
};

/// The operator, and what its rows are at nodes, whose times may lie in the next period.
struct PeriodForce {
  CircleOperator whole;
  std::vector<CollocationNode> nodes;
  Eigen::MatrixXd lift;  ///< [sensed numbers of all nodes x rows]
};

/// Of a cut in which every surface was cut by the same arc one period earlier; the collocation by
/// polynomials.
PeriodForce period_force(const TipStructure& structure, const Collocation& collocation, double period_s);
/// The same with fewer polynomials, `most` on the longest arc.
PeriodForce with_fewer(const PeriodForce& force, Eigen::Index most);
/// The operator between some of its rows; between the columns of an orthonormal basis, which have no degrees.
CircleOperator chosen_rows(const CircleOperator& whole, const std::vector<Eigen::Index>& rows);
CircleOperator projected(const CircleOperator& whole, const Eigen::MatrixXd& basis);

}  // namespace stablecut::milling
