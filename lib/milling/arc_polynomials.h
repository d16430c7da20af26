// Polynomials along the arcs of a cut in the place of values at its nodes. README.md, "Polynomials along the
// arcs".
#pragma once

#include <Eigen/Core>

#include "milling/collocation.h"

namespace stablecut::milling {

/// Orthonormal columns [rows x columns]: polynomials along each arc, `most` on the longest arc and fewer on
/// shorter ones; of rows that are polynomials already, the first of each arc.
Eigen::MatrixXd arc_polynomials(const Collocation& collocation, Eigen::Index most);

/// [rows] Square root of the quadrature weight of each row's node: what is sensed times this has the
/// integral's norm. Ones where the rows are polynomials.
Eigen::VectorXd root_weights(const Collocation& collocation);

/// The same collocation with the coefficients of such polynomials as rows, of a cut in which every piece is
/// an arc and was cut by itself one period earlier.
Collocation along_arcs(const Collocation& collocation, Eigen::Index most);

}  // namespace stablecut::milling
