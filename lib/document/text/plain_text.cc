#include "document/text/plain_text.h"

#include <algorithm>
#include <array>
#include <cctype>

namespace stablecut::document {
namespace {

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

bool is_blank(char c) { return std::string_view(kBlanks).find(c) != std::string_view::npos; }

std::string_view trimmed(std::string_view text) {
  const auto from = text.find_first_not_of(kBlanks);
  if (from == std::string_view::npos) return {};
  return text.substr(from, text.find_last_not_of(kBlanks) - from + 1);
}

bool is_utf16(std::string_view text) { return text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF"); }

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

std::string printable(std::string text) {
  for (std::size_t i = 0; i < text.size();) {
    const std::string_view rest = std::string_view(text).substr(i);
    const std::size_t length = utf8_length(rest);
    if (length == 0) text[i] = '?';
    const bool is_control = length == 1 && (static_cast<unsigned char>(text[i]) < 0x20 || text[i] == 0x7f);
    // The controls of Latin-1, some of which terminals follow too.
    const bool is_high_control =
        length == 2 && rest[0] == '\xC2' && static_cast<unsigned char>(rest[1]) < 0xA0;
    if (is_control || is_high_control) std::fill_n(text.begin() + i, length, ' ');
    i += std::max<std::size_t>(length, 1);
  }
  return text;
}

}  // namespace stablecut::document
