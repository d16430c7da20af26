// Eigenvalues of several real matrices side by side: neighbouring points of a stability chart in the lanes of
// one vector register.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace stablecut::numerics {

/// All eigenvalues of each matrix, in no particular order; the matrices square, real and of one size.
/// Householder reduction to Hessenberg form, then the implicit double-shift QR iteration on each matrix's
/// active block, some 8 n^3 flops each. The matrices go through in step, eight at a time, so those whose
/// spectra are alike cost least. Backward stable. Throws InvalidArgument when an entry is not finite.
/// Where the iteration stalls, or squares of entries would overflow, a matrix is solved by itself; `alone`
/// counts those.
std::vector<Eigen::VectorXcd> eigenvalues_of_each(const std::vector<Eigen::MatrixXd>& matrices,
                                                  std::size_t* alone = nullptr);

}  // namespace stablecut::numerics
