// Kernels on plain arrays, built for several widths of vector registers.
#pragma once

/// Put before a function whose loops should use wide vectors where the processor has them. Its sums must be
/// in lanes of a fixed number, so that every width gives the same bits; fused multiply-adds are off
/// everywhere.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define STABLECUT_WIDE __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define STABLECUT_WIDE
#endif
#define STABLECUT_INLINE inline __attribute__((always_inline))
