#include "document/text/data_error.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include "base/number_text.h"
#include "document/text/plain_text.h"

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
  return printable(std::move(value));
}

}  // namespace stablecut::document
