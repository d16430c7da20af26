// Eigenvalues of a real matrix, without vectors: the hot loop of a stability chart.
#pragma once

#include <Eigen/Core>

namespace stablecut::numerics {

/// All eigenvalues of a square real matrix, in no particular order, by Eigen's Schur form: where the faster
/// ways of this room fail. Throws InvalidArgument when an entry is not finite.
Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& matrix);

/// Share of the largest modulus from which on an eigenvalue is a leading one.
inline constexpr double kLeading = 0.75;

/// At least the leading eigenvalues with imaginary parts not below zero of [states | rest], a matrix whose
/// first `states` rows and columns are in other units than the rest; perhaps others too.
///
/// Both parts are brought to one size, and the Hessenberg reduction (an orthonormal Krylov basis, from a
/// vector without preference) stops early: where what is not reduced yet has a norm well below the largest
/// modulus, the leading eigenvalues of the reduced part are followed as the basis grows, until a step moves
/// none of them by more than 1e-11 of max(1, modulus); then all of the block are returned. A compact map of
/// few modes needs little more than their states. In tests on random maps no larger one was missed; it is not
/// a proof. Throws InvalidArgument when an entry is not finite.
Eigen::VectorXcd leading_eigenvalues(Eigen::MatrixXd matrix, Eigen::Index states);

}  // namespace stablecut::numerics
