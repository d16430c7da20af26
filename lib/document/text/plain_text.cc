#include "document/text/plain_text.h"

#include <algorithm>
#include <array>
#include <cctype>

namespace stablecut::document {

bool is_blank(char c) { return std::string_view(kBlanks).find(c) != std::string_view::npos; }

std::string_view trimmed(std::string_view text) {
  const auto from = text.find_first_not_of(kBlanks);
  if (from == std::string_view::npos) return {};
  return text.substr(from, text.find_last_not_of(kBlanks) - from + 1);
}

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

std::string plain_signs(std::string_view text) {
  static constexpr std::array<std::array<std::string_view, 2>, 7> kSigns = {{{"\xC2\xB5", "u"},
                                                                             {"\xCE\xBC", "u"},
                                                                             {"\xB5", "u"},
                                                                             {"\xC2\xB2", "^2"},
                                                                             {"\xB2", "^2"},
                                                                             {"\xC2\xB7", "*"},
                                                                             {"\xB7", "*"}}};
  std::string result;
  while (!text.empty()) {
    const auto sign = std::find_if(kSigns.begin(), kSigns.end(),
                                   [&](const auto& candidate) { return text.starts_with(candidate[0]); });
    if (sign == kSigns.end()) {
      result += text.front();
      text.remove_prefix(1);
    } else {
      result += (*sign)[1];
      text.remove_prefix((*sign)[0].size());
    }
  }
  return result;
}

}  // namespace stablecut::document
