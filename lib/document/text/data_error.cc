#include "document/text/data_error.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include "base/number_text.h"

namespace stablecut::document {
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

// Bytes of the UTF-8 character at the front of the text, which is not empty; 0 where it is none.
std::size_t utf8_length(std::string_view text) {
  const auto first = static_cast<unsigned char>(text[0]);
  const std::size_t length = first < 0x80                    ? 1
                             : first >= 0xC2 && first < 0xE0 ? 2
                             : (first & 0xF0) == 0xE0        ? 3
                             : (first & 0xF8) == 0xF0        ? 4
                                                             : 0;
  if (length > text.size()) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((static_cast<unsigned char>(text[i]) & 0xC0) != 0x80) return 0;
  }
  return length;
}

}  // namespace

DataError::DataError(const std::string& file, const std::string& place, const std::string& value,
                     const std::string& expected, Remedy remedy)
    : std::runtime_error(joined(file, place, shown(value), expected)), remedy_(remedy) {}

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

std::string lines_text(const Eigen::VectorXd& frequency_hz) {
  return std::to_string(frequency_hz.size()) + " lines from " + number_text(frequency_hz[0]) + " to " +
         number_text(frequency_hz[frequency_hz.size() - 1]) + " Hz";
}

std::string shown(std::string value) {
  constexpr std::size_t kLongest = 60;
  if (value.size() > kLongest) {
    std::size_t cut = kLongest;
    while (cut > 0 && (static_cast<unsigned char>(value[cut]) & 0xC0) == 0x80) --cut;  // keep UTF-8 whole
    value = value.substr(0, cut) + "...";
  }
  for (std::size_t i = 0; i < value.size();) {
    const std::size_t length = utf8_length(std::string_view(value).substr(i));
    if (length == 0) value[i] = '?';
    if (length == 1 && (static_cast<unsigned char>(value[i]) < 0x20 || value[i] == 0x7f)) value[i] = ' ';
    i += std::max<std::size_t>(length, 1);
  }
  return value;
}

}  // namespace stablecut::document
