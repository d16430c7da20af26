// How near two names are to each other.
#pragma once

#include <cstddef>
#include <string_view>

namespace stablecut {

/// How many letters are to be added, taken, replaced or changed with their neighbour to make one name of the
/// other (optimal string alignment [Damerau1964]).
std::size_t edits_between(std::string_view a, std::string_view b);

}  // namespace stablecut
