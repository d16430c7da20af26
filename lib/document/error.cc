#include "document/error.h"

#include <cstdio>
#include <utility>

namespace stablecut {
namespace {

std::string joined(const std::string& file, const std::string& place, const std::string& value,
                   const std::string& expected) {
  std::string text;
  for (const auto* part : {&file, &place, &value, &expected}) {
    if (part->empty()) continue;
    if (!text.empty()) text += ": ";
    text += *part;
  }
  return text;
}

}  // namespace

DataError::DataError(const std::string& file, const std::string& place, const std::string& value,
                     const std::string& expected)
    : std::runtime_error(joined(file, place, shown(value), expected)) {}

std::string pointer_step(const std::string& pointer, const std::string& step) {
  std::string result = pointer + '/';
  for (const char c : step) {
    if (c == '~')
      result += "~0";
    else if (c == '/')
      result += "~1";
    else
      result += c;
  }
  return result;
}

std::string line_place(long line) { return "line " + std::to_string(line); }

std::string short_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

std::string shown(std::string value) {
  constexpr std::size_t kLongest = 60;
  if (value.size() > kLongest) {
    std::size_t cut = kLongest;
    while (cut > 0 && (static_cast<unsigned char>(value[cut]) & 0xC0) == 0x80) --cut;  // keep UTF-8 whole
    value = value.substr(0, cut) + "...";
  }
  for (char& c : value) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  }
  return value;
}

}  // namespace stablecut
