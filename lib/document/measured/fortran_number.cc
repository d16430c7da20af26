#include "document/measured/fortran_number.h"

#include <charconv>
#include <limits>
#include <string>
#include <utility>

#include "document/text/plain_text.h"

namespace stablecut::document {
namespace {

constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_exponent_letter(char c) {
  return c == 'e' || c == 'E' || c == 'd' || c == 'D' || c == 'q' || c == 'Q';
}

// Takes off a whole word that stands for no finite number.
std::optional<double> take_word(std::string_view& text) {
  std::size_t end = 0;
  while (end < text.size() && !is_blank(text[end])) ++end;
  std::string word(text.substr(0, end));
  std::erase_if(word, [](char c) { return c == '+' || c == '-'; });
  word = lower(std::move(word));
  const bool stars = !word.empty() && word.find_first_not_of('*') == std::string::npos;
  if (!stars && !word.starts_with("nan") && !word.starts_with("inf")) return std::nullopt;
  text.remove_prefix(end);
  return kNotANumber;
}

}  // namespace

std::optional<double> take_number(std::string_view& text) {
  std::size_t at = 0;
  const auto peek = [&](std::size_t i) { return i < text.size() ? text[i] : '\0'; };
  if (peek(at) == '+' || peek(at) == '-') ++at;
  const std::size_t digits_from = at;
  while (is_digit(peek(at))) ++at;
  if (peek(at) == '.') ++at;
  while (is_digit(peek(at))) ++at;
  const std::size_t mantissa_end = at;
  std::size_t exponent_from = 0;  // of its sign or first digit; 0 for none
  const auto sign_and_digits = [&](std::size_t i) {
    return is_digit(peek(i)) || ((peek(i) == '+' || peek(i) == '-') && is_digit(peek(i + 1)));
  };
  if (is_exponent_letter(peek(at)) && sign_and_digits(at + 1)) {
    exponent_from = at + 1;
  } else if ((peek(at) == '+' || peek(at) == '-') && is_digit(peek(at + 1)) && is_digit(peek(at + 2)) &&
             is_digit(peek(at + 3)) && !is_digit(peek(at + 4)) && peek(at + 4) != '.') {
    exponent_from = at;
  }
  const bool has_digits =
      mantissa_end > digits_from && !(mantissa_end == digits_from + 1 && text[digits_from] == '.');
  if (!has_digits) return take_word(text);
  if (peek(at) == '#') {  // 1.#QNAN of old run-time libraries
    while (at < text.size() && !is_blank(text[at])) ++at;
    text.remove_prefix(at);
    return kNotANumber;
  }
  std::size_t end = mantissa_end;
  if (exponent_from > 0) {
    end = exponent_from + (is_digit(text[exponent_from]) ? 0 : 1);
    while (is_digit(peek(end))) ++end;
  }
  double value = 0;
  const std::size_t from = text.front() == '+' ? 1 : 0;
  const bool plain = exponent_from == 0 || ((peek(mantissa_end) == 'e' || peek(mantissa_end) == 'E'));
  std::from_chars_result result{};
  if (plain) {
    result = std::from_chars(text.data() + from, text.data() + end, value);
  } else {
    std::string rewritten(text.substr(from, mantissa_end - from));
    rewritten += 'e';
    rewritten += text.substr(exponent_from, end - exponent_from);
    result = std::from_chars(rewritten.data(), rewritten.data() + rewritten.size(), value);
  }
  if (result.ec == std::errc::result_out_of_range) {
    // Below the least double is 0; above the largest is no number.
    value = exponent_from > 0 && text[exponent_from] == '-' ? 0 : kNotANumber;
  } else if (result.ec != std::errc()) {
    return std::nullopt;
  }
  text.remove_prefix(end);
  return value;
}

}  // namespace stablecut::document
