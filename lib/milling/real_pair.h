// Two eigenvalues of a real operator that are nearly one. README.md, "The search on the unit circle".
#pragma once

#include <optional>

#include "milling/circle_operator.h"

namespace stablecut::milling {

/// Eigenvalues mean +- sqrt(square) of M at +1 or -1. Both numbers depend smoothly on the operator, where the
/// eigenvalues become one and conjugate.
struct RealPair {
  double angle = 0;  ///< 0 or pi
  double mean = 0, square = 0;
};

/// The pair of another operator of the same cut that is near; none where no two eigenvalues are nearer to the
/// mean than all others.
std::optional<RealPair> real_pair(const CircleOperator& of, const RealPair& near);

}  // namespace stablecut::milling
