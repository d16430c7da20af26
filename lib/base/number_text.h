// Numbers in messages.
#pragma once

#include <string>

namespace stablecut {

/// A number in a message: `120.5`, `1e-09`. Every message prints its numbers by this: what was read with six
/// digits, what was estimated with three.
std::string number_text(double value, int digits = 6);

/// A share in percent: `0.35 %`, `12 %`.
std::string percent_text(double share);

/// A number in a printf format for one double, at most 63 characters long: where a file's form asks for it.
std::string printed(const char* format, double value);

}  // namespace stablecut
