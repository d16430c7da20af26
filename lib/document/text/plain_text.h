// Letters, blanks and signs of files that people and instruments write.
#pragma once

#include <string>
#include <string_view>

namespace stablecut::document {

/// Blanks within a line: spaces, tabs, carriage returns.
inline constexpr const char* kBlanks = " \t\r\v\f";
bool is_blank(char c);
/// The text without blanks at its ends.
std::string_view trimmed(std::string_view text);

/// True where the text begins with a byte order mark of UTF-16.
bool is_utf16(std::string_view text);

/// Letters of ASCII in lower case.
std::string lower(std::string text);

/// Signs of UTF-8 and Latin-1 in plain letters: a micro sign as u, a raised 2 as ^2, a middle dot as *.
std::string plain_signs(std::string_view text);

/// The text with a blank for each control character and a question mark for each byte that is not UTF-8, of
/// the same length: nothing in it moves a terminal.
std::string printable(std::string text);

}  // namespace stablecut::document
