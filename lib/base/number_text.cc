#include "base/number_text.h"

#include <cstdio>

namespace stablecut {

std::string printed(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::string number_text(double value, int digits) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*g", digits, value);
  return text;
}

std::string percent_text(double share) { return printed(share < 0.1 ? "%.2g %%" : "%.0f %%", 100 * share); }

}  // namespace stablecut
