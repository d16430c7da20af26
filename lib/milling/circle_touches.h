// Passages of the unit circle that are close together or nearly are: of a touch, where the imaginary part of
// an eigenvalue is least or greatest and nearly 0, and of a pair of eigenvalues at +1 or -1 that are nearly
// one. README.md, "Touches".
#pragma once

#include <complex>
#include <functional>
#include <vector>

#include "milling/circle_scan.h"

namespace stablecut::milling {

/// Where to seek the two passages of each touch that has them and that the search is not well clear of: from
/// the touch outwards, so that Newton's method finds both.
std::vector<Start> starts_beside(const std::vector<CirclePassage>& touches);

/// The pairs of an operator near those of its search, from which the starts at +1 and -1 are set anew: two of
/// each pair that is real, none of one that is not. A pair that is not found leaves the starts as they are.
std::vector<RealPair> pairs_of_whole(const CircleOperator& whole, const std::vector<RealPair>& of_search,
                                     std::vector<Start>& starts);

/// Whether two results of Newton's method are one.
bool are_one(const CirclePassage& a, const CirclePassage& b);

/// Whether a finer operator changes some touch or pair by so much that it may be two passages, or none.
/// `value_there`: the finer operator's eigenvalue near that of a passage.
bool are_doubtful(const CirclePassages& passages, const CircleOperator& finer,
                  const std::function<std::complex<double>(const CirclePassage&)>& value_there);

}  // namespace stablecut::milling
