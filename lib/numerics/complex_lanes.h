// Complex numbers in vector lanes, inside kernels (see lanes.h).
#pragma once

#include "numerics/lanes.h"

namespace stablecut::numerics {

/// Doubles of one complex number in each lane: the real parts, then the imaginary ones.
inline constexpr std::ptrdiff_t kComplexLanes = 2 * kLanes;

struct ComplexLanes {
  Lanes re, im;
};

STABLECUT_INLINE ComplexLanes load_complex(const double* from) {
  return {load_lanes(from), load_lanes(from + kLanes)};
}
STABLECUT_INLINE void store_complex(const ComplexLanes& z, double* to) {
  store_lanes(z.re, to);
  store_lanes(z.im, to + kLanes);
}
STABLECUT_INLINE ComplexLanes operator+(const ComplexLanes& a, const ComplexLanes& b) {
  return {a.re + b.re, a.im + b.im};
}
STABLECUT_INLINE ComplexLanes operator-(const ComplexLanes& a, const ComplexLanes& b) {
  return {a.re - b.re, a.im - b.im};
}
STABLECUT_INLINE ComplexLanes operator*(const ComplexLanes& a, const ComplexLanes& b) {
  return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
}
STABLECUT_INLINE ComplexLanes operator*(const Lanes& a, const ComplexLanes& b) {
  return {a * b.re, a * b.im};
}
/// conj(a) b.
STABLECUT_INLINE ComplexLanes conjugate_times(const ComplexLanes& a, const ComplexLanes& b) {
  return {a.re * b.re + a.im * b.im, a.re * b.im - a.im * b.re};
}
STABLECUT_INLINE Lanes square_of(const ComplexLanes& z) { return z.re * z.re + z.im * z.im; }
STABLECUT_INLINE ComplexLanes conjugate(const ComplexLanes& z) { return {z.re, -z.im}; }
/// a / b; b not zero, and its square finite.
STABLECUT_INLINE ComplexLanes quotient(const ComplexLanes& a, const ComplexLanes& b) {
  return (1.0 / square_of(b)) * conjugate_times(b, a);
}

}  // namespace stablecut::numerics
