// Random numbers that are the same with every standard library: its distributions differ between them.
#pragma once

#include <cmath>
#include <complex>
#include <random>

#include "base/units.h"

namespace stablecut::numerics {

/// Uniform in [from, to): 53 bits.
inline double uniform(std::mt19937_64& generator, double from, double to) {
  return from + (to - from) * static_cast<double>(generator() >> 11) * 0x1p-53;
}

/// A circular complex normal number of mean square 1 [BoxMuller1958].
inline std::complex<double> unit_complex_normal(std::mt19937_64& generator) {
  const double share = (static_cast<double>(generator() >> 11) + 0.5) * 0x1p-53;
  const double phase = kTwoPi * static_cast<double>(generator() >> 11) * 0x1p-53;
  return std::polar(std::sqrt(-std::log(share)), phase);
}

/// A normal number of mean 0 and variance 1.
inline double unit_normal(std::mt19937_64& generator) {
  return std::sqrt(2.0) * unit_complex_normal(generator).real();
}

}  // namespace stablecut::numerics
