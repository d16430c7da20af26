// What the QR iteration of [Francis1961] decides, the same for one matrix and for several side by side.
// README.md, "Eigenvalues".
#pragma once

#include <cmath>
#include <complex>
#include <limits>
#include <utility>

namespace stablecut::numerics {

/// A subdiagonal entry is zero when it is not larger than this share of its diagonal neighbours' size.
inline constexpr double kRounding = std::numeric_limits<double>::epsilon();
/// Sweeps for one eigenvalue before it is given up, and after how many the shifts are others.
inline constexpr int kPatience = 60, kStuck = 10;

/// Sum and product of a sweep's two shifts.
struct ShiftPair {
  double sum, product;
};

/// The eigenvalues of the last block [a b; c d] as shifts; where `sweeps` of them did not help, two of the
/// size of the last two subdiagonal entries [Martin1970].
inline ShiftPair shifts_of(double a, double b, double c, double d, double before_c, int sweeps) {
  if (sweeps % kStuck != 0) return {a + d, a * d - b * c};
  const double size = std::abs(c) + std::abs(before_c);
  return {1.5 * size, size * size};
}

/// The eigenvalues of [a b; c d] from a, b c and d; of a complex pair the one above the real axis first.
inline std::pair<std::complex<double>, std::complex<double>> block_eigenvalues(double a, double bc,
                                                                               double d) {
  const double half = (a - d) / 2, discriminant = half * half + bc;
  const double root = std::sqrt(std::abs(discriminant));
  if (discriminant < 0) return {{d + half, root}, {d + half, -root}};
  const double larger = half + std::copysign(root, half);  // no cancellation
  return {d + larger, larger == 0 ? d : d - bc / larger};
}

}  // namespace stablecut::numerics
