// A small space of differences that has the large eigenvalues of a circle operator everywhere on the unit
// circle. README.md, "The search on the unit circle".
#pragma once

#include <Eigen/Core>
#include <complex>
#include <vector>

#include "milling/circle_operator.h"

namespace stablecut::milling {

/// [rows x columns] Orthonormal: whatever multiplies or is felt by more than `least` is in it, of the
/// operator's right and of its left vectors.
Eigen::MatrixXd leading_basis(const CircleOperator& of, double least);

/// An eigenvalue at an angle with its vectors, of norm 1.
struct EigenTriple {
  double angle = 0;
  std::complex<double> value;
  Eigen::VectorXcd right, left;  ///< [rows]
};

/// How far vectors are from being eigenvectors: [rows x triples] M x / kappa - x, and the same of the left
/// ones.
struct Residuals {
  Eigen::MatrixXcd right, left;
};
Residuals residuals(const CircleOperator& of, const std::vector<EigenTriple>& triples);

/// The basis and what the residuals have beside it.
Eigen::MatrixXd enriched(const Eigen::MatrixXd& basis, const Residuals& by);

/// The eigenvalue of an operator near that of vectors that have it to some digits, if nothing but the part of
/// the vectors that they lack is missing: the quotient y^H M x / y^H x of vectors that M has gone over once.
std::complex<double> corrected_value(const CircleOperator& of, const EigenTriple& triple);

}  // namespace stablecut::milling
