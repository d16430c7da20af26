// Kernels on plain arrays, built for several widths of vector registers.
//
// Files with such kernels are compiled with -Wno-psabi: their vectors are never passed between files.
#pragma once

#include <cstddef>
#include <cstring>

/// Put before a function whose loops should use wide vectors where the processor has them. Its sums must be
/// in lanes of a fixed number, so that every width gives the same bits; fused multiply-adds are off
/// everywhere.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define STABLECUT_WIDE __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define STABLECUT_WIDE
#endif
#define STABLECUT_INLINE inline __attribute__((always_inline))

namespace stablecut::numerics {

/// Doubles that the compiler keeps side by side: one register of 512 bits, two of 256 or four of 128.
inline constexpr std::ptrdiff_t kLanes = 8;
typedef double Lanes __attribute__((vector_size(kLanes * sizeof(double))));

STABLECUT_INLINE Lanes load_lanes(const double* from) {
  Lanes v;
  std::memcpy(&v, from, sizeof v);
  return v;
}
STABLECUT_INLINE void store_lanes(const Lanes& v, double* to) { std::memcpy(to, &v, sizeof v); }
STABLECUT_INLINE double sum_of(const Lanes& v) {
  return ((v[0] + v[1]) + (v[2] + v[3])) + ((v[4] + v[5]) + (v[6] + v[7]));
}

}  // namespace stablecut::numerics
