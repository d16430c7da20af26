#include "document/measured/tap_column_name.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>
#include <vector>

#include "document/measured/frf_unit.h"
#include "document/text/plain_text.h"

namespace stablecut::document {
namespace {

bool is_direction(std::string_view word) { return word == "x" || word == "y" || word == "z"; }

bool among(std::string_view words, const std::string& word) {
  return words.find(" " + word + " ") != std::string_view::npos;
}

// The words of a name, in lower case; a sign stands with the word behind it.
std::vector<std::string> words_of(const std::string& text) {
  std::vector<std::string> words;
  std::string word;
  const auto end = [&] {
    if (!word.empty() && word != "-" && word != "+") words.push_back(word);
    word.clear();
  };
  for (const char c : lower(text)) {
    const bool letter = std::isalpha(static_cast<unsigned char>(c)) != 0;
    if (letter) {
      word += c;
      continue;
    }
    end();
    if (c == '-' || c == '+') word = c;
  }
  end();
  return words;
}

class TapNameReader {
 public:
  explicit TapNameReader(const std::string& field) : text_(plain_signs(field)) {}

  std::optional<TapColumnName> read() {
    take_unit();
    for (std::string word : words_of(text_)) read_word(std::move(word));
    if (!kind_ && name_.quantity) kind_ = TapColumnKind::kResponse;
    if (!kind_ && !name_.direction.empty()) kind_ = TapColumnKind::kResponse;
    if (!kind_) return std::nullopt;
    name_.kind = *kind_;
    return name_;
  }

 private:
  // In brackets, or behind the last blank or underscore.
  void take_unit() {
    const auto open = text_.find_first_of("[(");
    if (open != std::string::npos) {
      const auto close = text_.find_last_of("])");
      const std::string inside =
          text_.substr(open + 1, close == std::string::npos || close < open ? close : close - open - 1);
      if (!take_unit_named(inside)) name_.unit = inside;
      text_.erase(open);
      return;
    }
    const auto per = text_.find("_per_");
    const auto last = per == std::string::npos ? text_.find_last_of(" _") : text_.find_last_of(" _", per - 1);
    if (last == std::string::npos || last == 0) return;
    std::string unit = text_.substr(last + 1);
    if (const auto at = unit.find("_per_"); at != std::string::npos) unit.replace(at, 5, "/");
    if (!is_direction(lower(unit)) && take_unit_named(unit)) text_.erase(last);
  }

  bool take_unit_named(const std::string& unit) {
    if (const auto volts = voltage_unit(unit)) {
      name_.in_volts = true;
      name_.to_si = *volts;
    } else if (const auto known = physical_unit(unit)) {
      const bool motion = known->length == 1 && known->force == 0 && known->time <= 0 && known->time >= -2;
      if (known->force == 1 && known->length == 0 && known->time == 0)
        kind_ = TapColumnKind::kForce;
      else if (known->time == 1 && known->length == 0 && known->force == 0)
        kind_ = TapColumnKind::kTime;
      else if (motion)
        name_.quantity = static_cast<dynamics::Quantity>(-known->time);
      else
        return false;
      name_.to_si = known->to_si;
    } else {
      return false;
    }
    name_.unit = unit;
    name_.unit_known = true;
    return true;
  }

  void read_word(std::string word) {
    const std::string sign = word[0] == '-' ? "-" : "";
    if (word[0] == '-' || word[0] == '+') word.erase(0, 1);
    if (is_direction(word)) {
      name_.direction = sign + word;
      return;
    }
    // ax, vy, fz, and accx, forcey.
    if (word.size() > 1 && is_direction(word.substr(word.size() - 1)) &&
        understood(word.substr(0, word.size() - 1))) {
      name_.direction = sign + word.back();
      word.pop_back();
    }
    understood(word);
  }

  // Whether the word tells what the column holds; kept where the unit has not told.
  bool understood(const std::string& word) {
    static constexpr std::array kMotions = {
        std::string_view(" d u disp displ displacement weg deflection "),
        std::string_view(" v vel velo velocity geschwindigkeit "),
        std::string_view(" a acc accel acceleration accelerometer beschleunigung ")};
    if (among(" t time times zeit temps ", word)) return told(TapColumnKind::kTime);
    if (among(" f force hammer kraft impact impulse load input excitation ", word))
      return told(TapColumnKind::kForce);
    for (std::size_t order = 0; order < kMotions.size(); ++order) {
      if (!among(kMotions[order], word)) continue;
      if (!name_.quantity) name_.quantity = static_cast<dynamics::Quantity>(order);
      return told(TapColumnKind::kResponse);
    }
    if (among(" response resp output answer sensor antwort ", word)) return told(TapColumnKind::kResponse);
    return false;
  }

  bool told(TapColumnKind kind) {
    if (!kind_) kind_ = kind;
    return true;
  }

  std::string text_;
  TapColumnName name_;
  std::optional<TapColumnKind> kind_;
};

}  // namespace

std::optional<double> voltage_unit(const std::string& text) {
  const std::string unit = lower(std::string(trimmed(text)));
  if (unit == "v" || unit == "volt" || unit == "volts") return 1;
  if (unit == "mv" || unit == "millivolt" || unit == "millivolts") return 1e-3;
  if (unit == "uv" || unit == "microvolt" || unit == "microvolts") return 1e-6;
  return std::nullopt;
}

std::optional<TapColumnName> tap_column_name(const std::string& field) { return TapNameReader(field).read(); }

}  // namespace stablecut::document
