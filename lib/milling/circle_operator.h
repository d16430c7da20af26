// The cutting force of one period as an operator on the unit circle. README.md, "Limits from the unit
// circle".
#pragma once

#include <Eigen/Core>
#include <complex>
#include <vector>

#include "milling/collocation.h"
#include "milling/structure.h"

namespace stablecut::milling {

/// What a period's collocation says of motions that are multiplied by mu over the period: the differences d
/// that its rows sense obey d = depth * M(mu) d,
///   M(mu) = V + U G(mu) B + (V' + U' G(mu) B) / mu,   G(mu) = (mu - free flight)^-1,
/// so that a depth is one with multiplier mu exactly when 1 / depth is an eigenvalue of M(mu). In a basis of
/// the rows' space that is orthonormal for integrals over the period.
struct CircleOperator {
  Eigen::MatrixXd direct, direct_before;      ///< V, V' [size x size]
  Eigen::MatrixXd of_state, of_state_before;  ///< U, U' [size x 2 modes]
  Eigen::MatrixXd state_of;                   ///< B [2 modes x size]
  Eigen::VectorXcd growth;                    ///< [modes] what free flight multiplies each mode by

  /// Every surface was cut one period earlier: V' = -V and U' = -U, which are not kept.
  bool plain() const { return direct_before.size() == 0; }
  Eigen::Index size() const { return direct.rows(); }
};

/// The operator through all points; or between the columns of an orthonormal basis.
CircleOperator circle_operator(const TipStructure& structure, const Collocation& collocation,
                               double period_s);
CircleOperator projected(const CircleOperator& whole, const Eigen::MatrixXd& basis);

}  // namespace stablecut::milling
