// Normally distributed numbers, the same with every standard library.
#pragma once

#include <cmath>
#include <complex>
#include <random>

#include "base/units.h"

namespace stablecut::numerics {

/// A circular complex normal number of mean square 1 (Box and Muller on 53-bit uniforms;
/// std::normal_distribution differs between libraries).
inline std::complex<double> unit_complex_normal(std::mt19937_64& generator) {
  const double uniform = (static_cast<double>(generator() >> 11) + 0.5) * 0x1p-53;
  const double phase = kTwoPi * static_cast<double>(generator() >> 11) * 0x1p-53;
  return std::polar(std::sqrt(-std::log(uniform)), phase);
}

}  // namespace stablecut::numerics
