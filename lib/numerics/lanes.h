// Kernels on plain arrays, built for several widths of vector registers.
//
// Files with such kernels are compiled with -Wno-psabi: their vectors are never passed between files.
#pragma once

#include <cstddef>
#include <cstring>

/// Put before a function whose loops should use wide vectors where the processor has them. Its sums must be
/// in lanes of a fixed number, so that every width gives the same bits; fused multiply-adds are off
/// everywhere.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define STABLECUT_WIDE __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define STABLECUT_WIDE
#endif
#define STABLECUT_INLINE inline __attribute__((always_inline))
/// Put behind the parameters of a lambda inside such a function: left as a function of its own it would be
/// built for the narrowest registers only, and pass vectors in other places than its caller looks for them.
#define STABLECUT_INLINE_LAMBDA __attribute__((always_inline))

namespace stablecut::numerics {

/// Doubles that the compiler keeps side by side: one register of 512 bits, two of 256 or four of 128.
inline constexpr std::ptrdiff_t kLanes = 8;
typedef double Lanes __attribute__((vector_size(kLanes * sizeof(double))));

/// Half as many, for what comes in fours.
inline constexpr std::ptrdiff_t kFourLanes = 4;
typedef double FourLanes __attribute__((vector_size(kFourLanes * sizeof(double))));

// Of either kind of vector.

template <typename V = Lanes>
STABLECUT_INLINE V load_lanes(const double* from) {
  V v;
  std::memcpy(&v, from, sizeof v);
  return v;
}
template <typename V>
STABLECUT_INLINE void store_lanes(const V& v, double* to) {
  std::memcpy(to, &v, sizeof v);
}

template <typename V>
STABLECUT_INLINE V square_root(const V& x) {
  V result;
  for (std::size_t lane = 0; lane < sizeof x / sizeof(double); ++lane) result[lane] = __builtin_sqrt(x[lane]);
  return result;
}
template <typename V>
STABLECUT_INLINE V absolute(const V& x) {
  return x < 0.0 ? -x : x;
}
/// The size of one with the sign of the other; a zero counts as positive whatever its sign.
template <typename V>
STABLECUT_INLINE V with_sign(const V& size, const V& like) {
  return like < 0.0 ? -size : size;
}
template <typename V>
STABLECUT_INLINE V least(const V& a, const V& b) {
  return a < b ? a : b;
}
template <typename V>
STABLECUT_INLINE V largest(const V& a, const V& b) {
  return a > b ? a : b;
}
/// In the same order on every processor.
STABLECUT_INLINE double sum_of(const Lanes& v) {
  return ((v[0] + v[1]) + (v[2] + v[3])) + ((v[4] + v[5]) + (v[6] + v[7]));
}

/// The lanes' worth of numbers that `count` fill up to.
template <typename Integer>
constexpr Integer whole_lanes(Integer count) {
  return (count + kLanes - 1) / kLanes * kLanes;
}

}  // namespace stablecut::numerics
