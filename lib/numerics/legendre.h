// Legendre polynomials and Gauss's quadrature.
#pragma once

#include <Eigen/Core>

namespace stablecut::numerics {

/// Gauss-Legendre nodes (increasing) and weights on [-1, 1].
struct GaussRule {
  Eigen::VectorXd node;
  Eigen::VectorXd weight;
};
GaussRule gauss_legendre(Eigen::Index points);

/// P_0(x) ... P_{count-1}(x).
Eigen::VectorXd legendre_values(double x, Eigen::Index count);

/// The same of norm 1 on [-1, 1]: sqrt(m + 1/2) P_m(x).
Eigen::VectorXd orthonormal_legendre(double x, Eigen::Index count);

/// [n x n]: coefficients of P_0 ... P_{n-1} from values at the rule's n nodes (exact: the products have
/// degree below 2n).
Eigen::MatrixXd legendre_transform(const GaussRule& rule);

}  // namespace stablecut::numerics
