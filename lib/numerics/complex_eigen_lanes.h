// Eigenvalues and eigenvectors of eight complex matrices side by side. README.md, "Complex matrices".
#pragma once

#include <Eigen/Core>
#include <array>
#include <complex>
#include <vector>

#include "numerics/lane_array.h"
#include "numerics/lanes.h"

namespace stablecut::numerics {

/// Eight complex matrices of one size, in place of which their Hessenberg forms are kept.
///
/// Numbers lie in blocks of 2 kLanes doubles: the real parts of all lanes, then their imaginary parts. Entry
/// (i, j) is block i n + j of `matrix()`, component i of a vector is block i.
class ComplexEigenLanes {
 public:
  explicit ComplexEigenLanes(Eigen::Index size);

  Eigen::Index size() const { return n_; }
  /// To be filled in before reduce().
  double* matrix() { return h_.data(); }

  /// Householder reduction to Hessenberg form, 40/3 n^3 flops a lane. The squares of entries must be finite.
  void reduce();

  /// After reduce(): all eigenvalues of each lane by single-shift QR sweeps, to `accuracy` times the size of
  /// the matrix (backward error), some 17 n^3 flops a lane. A lane that does not converge has NaN.
  std::array<std::vector<std::complex<double>>, kLanes> values(double accuracy);

  /// After reduce(): right and left eigenvectors (M x = kappa x, y^H M = kappa y^H; sizes arbitrary) of an
  /// eigenvalue near `shifts` in each lane, by two steps of inverse iteration; 80 n^2 flops a lane. n blocks.
  void vectors(const std::array<std::complex<double>, kLanes>& shifts, double* right, double* left);

  /// After reduce(): det(H - shift) of each lane over its modulus; 20 n^2 flops a lane.
  std::array<std::complex<double>, kLanes> determinant_phases(std::complex<double> shift);

 private:
  void triangular(const std::array<std::complex<double>, kLanes>& shifts);

  Eigen::Index n_;
  LaneArray h_, reflectors_, factors_, work_, rotations_;
  std::array<double, kLanes> norm_{};
};

}  // namespace stablecut::numerics
