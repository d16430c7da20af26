#include "document/measured/frf_unit.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>

#include "base/units.h"
#include "document/text/plain_text.h"

namespace stablecut::document {
namespace {

constexpr double kPoundForce = 4.4482216152605;  // N
constexpr int kMostNesting = 20;
constexpr int kLargestExponent = 9;

struct NamedUnit {
  std::string_view name;
  PhysicalUnit unit;
};

constexpr PhysicalUnit length(double to_si) { return {to_si, 1, 0, 0}; }
constexpr PhysicalUnit force(double to_si) { return {to_si, 0, 0, 1}; }

constexpr std::array kNames = {
    NamedUnit{"m", length(1)},
    NamedUnit{"mm", length(1e-3)},
    NamedUnit{"cm", length(1e-2)},
    NamedUnit{"um", length(1e-6)},
    NamedUnit{"micron", length(1e-6)},
    NamedUnit{"microns", length(1e-6)},
    NamedUnit{"micrometer", length(1e-6)},
    NamedUnit{"meter", length(1)},
    NamedUnit{"meters", length(1)},
    NamedUnit{"nm", length(1e-9)},
    NamedUnit{"in", length(0.0254)},
    NamedUnit{"inch", length(0.0254)},
    NamedUnit{"inches", length(0.0254)},
    NamedUnit{"mil", length(25.4e-6)},
    NamedUnit{"mils", length(25.4e-6)},
    NamedUnit{"ips", {0.0254, 1, -1, 0}},
    NamedUnit{"ft", length(0.3048)},
    NamedUnit{"s", {1, 0, 1, 0}},
    NamedUnit{"sec", {1, 0, 1, 0}},
    NamedUnit{"ms", {1e-3, 0, 1, 0}},
    NamedUnit{"g", {kStandardGravity, 1, -2, 0}},
    NamedUnit{"gn", {kStandardGravity, 1, -2, 0}},
    NamedUnit{"gs", {kStandardGravity, 1, -2, 0}},
    NamedUnit{"mg", {kStandardGravity * 1e-3, 1, -2, 0}},
    NamedUnit{"n", force(1)},
    NamedUnit{"newton", force(1)},
    NamedUnit{"newtons", force(1)},
    NamedUnit{"mn", force(1e-3)},
    NamedUnit{"kn", force(1e3)},
    NamedUnit{"dan", force(10)},
    NamedUnit{"lbf", force(kPoundForce)},
    NamedUnit{"lb", force(kPoundForce)},
    NamedUnit{"lbs", force(kPoundForce)},
    NamedUnit{"pounds", force(kPoundForce)},
    NamedUnit{"kgf", force(kStandardGravity)},
    NamedUnit{"kp", force(kStandardGravity)},
    NamedUnit{"kg", {1, -1, 2, 1}},
};

// Recursive descent over products and quotients, from left to right; blanks multiply.
class UnitParser {
 public:
  explicit UnitParser(std::string_view text) : text_(text) {}

  std::optional<PhysicalUnit> whole() {
    const auto unit = product(0);
    skip_blanks();
    return unit && at_ == text_.size() ? unit : std::nullopt;
  }

 private:
  void skip_blanks() {
    while (at_ < text_.size() && text_[at_] == ' ') ++at_;
  }
  char next() const { return at_ < text_.size() ? text_[at_] : '\0'; }
  static bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }

  std::optional<PhysicalUnit> product(int depth) {
    PhysicalUnit result;
    bool divide = false;
    for (bool first = true;; first = false) {
      skip_blanks();
      if (!first) {
        if (next() == '/' || next() == '*') {
          divide = next() == '/';
          ++at_;
          skip_blanks();
        } else if (next() == '(' || next() == '[' || next() == '1' || is_letter(next())) {
          divide = false;
        } else {
          return result;
        }
      }
      auto factor = power(depth);
      if (!factor) return std::nullopt;
      result.to_si = divide ? result.to_si / factor->to_si : result.to_si * factor->to_si;
      const int sign = divide ? -1 : 1;
      result.length += sign * factor->length;
      result.time += sign * factor->time;
      result.force += sign * factor->force;
    }
  }

  std::optional<PhysicalUnit> power(int depth) {
    if (depth > kMostNesting) return std::nullopt;
    std::optional<PhysicalUnit> base;
    if (next() == '(' || next() == '[') {
      const char close = next() == '(' ? ')' : ']';
      ++at_;
      base = product(depth + 1);
      skip_blanks();
      if (next() != close) return std::nullopt;
      ++at_;
    } else if (next() == '1') {
      ++at_;
      return PhysicalUnit{};
    } else {
      base = name();
    }
    if (!base) return std::nullopt;
    int exponent = 1;
    const bool marked = next() == '^' || text_.substr(at_).starts_with("**");
    if (marked) at_ += next() == '^' ? 1 : 2;
    if (marked || std::isdigit(static_cast<unsigned char>(next()))) {
      const auto [end, error] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), exponent);
      if (error != std::errc() || std::abs(exponent) > kLargestExponent) return std::nullopt;
      at_ = static_cast<std::size_t>(end - text_.data());
    }
    return PhysicalUnit{std::pow(base->to_si, exponent), base->length * exponent, base->time * exponent,
                        base->force * exponent};
  }

  std::optional<PhysicalUnit> name() {
    const std::size_t from = at_;
    while (is_letter(next())) ++at_;
    const std::string written(text_.substr(from, at_ - from));
    // Mega, unless all is in capitals.
    if (written == "MN" || (written.starts_with("M") && written.size() > 1 && !is_upper(text_)))
      return std::nullopt;
    const std::string wanted = lower(written);
    const auto found = std::find_if(kNames.begin(), kNames.end(),
                                    [&](const NamedUnit& unit) { return unit.name == wanted; });
    return found == kNames.end() ? std::nullopt : std::optional(found->unit);
  }

  // Written in capitals throughout, as old analysers do.
  static bool is_upper(std::string_view text) {
    return std::none_of(text.begin(), text.end(), [](char c) { return c >= 'a' && c <= 'z'; });
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

}  // namespace

std::optional<PhysicalUnit> physical_unit(std::string_view text) {
  std::string plain = plain_signs(text);
  if (const auto plural = plain.find("'s"); plural != std::string::npos) plain.erase(plural, 1);  // g's
  if (plain.find_first_not_of(' ') == std::string::npos) return std::nullopt;
  return UnitParser(plain).whole();
}

std::optional<FrfUnit> frf_unit(const PhysicalUnit& unit) {
  if (unit.length != 1 || unit.force != -1 || unit.time > 0 || unit.time < -2) return std::nullopt;
  return FrfUnit{static_cast<dynamics::Quantity>(-unit.time), unit.to_si};
}

std::optional<FrfUnit> frf_unit(std::string_view text) {
  const auto unit = physical_unit(text);
  return unit ? frf_unit(*unit) : std::nullopt;
}

std::optional<double> frequency_unit(std::string_view text) {
  std::string name = lower(std::string(text));
  std::erase_if(name, [](char c) { return c == ' ' || c == '[' || c == ']' || c == '(' || c == ')'; });
  if (name == "hz" || name == "1/s" || name == "c/s" || name == "cps" || name == "hertz") return 1;
  if (name == "khz") return 1e3;
  if (name == "rad/s" || name == "rad/sec") return 1 / kTwoPi;
  if (name == "rpm" || name == "cpm" || name == "1/min") return 1.0 / 60;
  return std::nullopt;
}

}  // namespace stablecut::document
