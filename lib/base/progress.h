#pragma once

#include <functional>

namespace stablecut {

/// Told the finished share of the work, 0 to 1, never decreasing, from one thread at a time. May be empty.
using Progress = std::function<void(double share)>;

}  // namespace stablecut
