// Polynomials along the arcs of a cut in the place of values at its nodes. README.md, "Polynomials along the
// arcs".
#pragma once

#include <Eigen/Core>
#include <vector>

#include "milling/collocation.h"

namespace stablecut::milling {

/// How many polynomials each arc has, `most` on the longest one and fewer on shorter ones.
std::vector<Eigen::Index> polynomials_on(const std::vector<double>& arc_length, Eigen::Index most);
/// [arcs] s.
std::vector<double> arc_lengths(const Collocation& collocation);

/// The same collocation with the coefficients of such polynomials as rows, of a cut in which every piece is
/// an arc and was cut by itself one period earlier.
Collocation along_arcs(const Collocation& collocation, Eigen::Index most);

}  // namespace stablecut::milling
