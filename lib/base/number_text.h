// Numbers in messages.
#pragma once

#include <string>

namespace stablecut {

/// A number in a printf format for one double, at most 63 characters long.
std::string printed(const char* format, double value);

/// A share in percent: `0.35 %`, `12 %`.
std::string percent(double share);

}  // namespace stablecut
