#include "document/measured/frf_column_name.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

#include "document/measured/frf_unit.h"
#include "document/text/plain_text.h"

namespace stablecut::document {
namespace {

bool is_direction(char c) { return c == 'x' || c == 'y' || c == 'z'; }

std::optional<ColumnPart> part_named(const std::string& word) {
  struct PartWords {
    ColumnPart part;
    std::string_view words;  // in lower case, each between blanks
  };
  static constexpr std::array kParts = {
      PartWords{ColumnPart::kFrequency, " f freq frequency hz khz omega frequenz frequence "},
      PartWords{ColumnPart::kReal, " re real realteil "},
      PartWords{ColumnPart::kImaginary, " im imag imaginary imagin imaginaerteil "},
      PartWords{ColumnPart::kMagnitude, " mag magnitude abs amp ampl amplitude modulus gain betrag "},
      PartWords{ColumnPart::kDecibel, " db "},
      PartWords{ColumnPart::kPhase, " phase ph phi arg angle "},
      PartWords{ColumnPart::kCoherence, " coh coherence "},
  };
  if (word.empty() || word.find(' ') != std::string::npos) return std::nullopt;
  for (const PartWords& known : kParts) {
    if (known.words.find(' ' + word + ' ') != std::string_view::npos) return known.part;
  }
  return std::nullopt;
}

// A direction by itself or of a force: x, fx. Nothing for other words.
std::string direction_named(const std::string& word) {
  const std::string letter = word.size() == 2 && word[0] == 'f' ? word.substr(1) : word;
  return letter.size() == 1 && is_direction(letter[0]) ? letter : "";
}

// As in Re(X/FX).
bool is_direction_pair(const std::string& low) {
  const auto slash = low.find('/');
  return slash != std::string::npos && !direction_named(low.substr(0, slash)).empty() &&
         !direction_named(low.substr(slash + 1)).empty();
}

// A unit, known or not; neither a part nor directions, as in Re(Hxx) or H(x/fy).
bool looks_like_unit(const std::string& text) {
  const std::string low = lower(text);
  for (const char* word : {"db", "deg", "degrees", "rad", "radians", "\xC2\xB0", "\xB0", "-"}) {
    if (low == word) return true;
  }
  if (is_direction_pair(low)) return false;
  const bool quotient = low.find('/') != std::string::npos && std::any_of(low.begin(), low.end(), [](char c) {
                          return std::isalpha(static_cast<unsigned char>(c)) && !is_direction(c);
                        });
  return quotient || physical_unit(text) || frequency_unit(text);
}

bool is_alphanumeric(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; }

// Takes a name apart: first the unit, which is cut off, then the words.
class NameReader {
 public:
  explicit NameReader(const std::string& field) : field_(field), text_(lower(field)) {}

  std::optional<ColumnName> read() {
    take_bracketed_unit();
    if (name_.unit.empty()) take_unit_with_per();
    if (name_.unit.empty()) take_unit_at_end();
    read_words();
    read_decibel();
    if (part_ == ColumnPart::kPhase && name_.unit.empty() && holds_unknown_unit()) name_.unit = inside_;
    if (!part_ && frequency_unit(name_.unit)) part_ = ColumnPart::kFrequency;
    if (!part_) return std::nullopt;
    if (part_ == ColumnPart::kFrequency && (text_.starts_with("omega") || lower(name_.unit) == "rad"))
      name_.unit = "rad/s";
    name_.part = *part_;
    if (directions_.size() == 2) {
      name_.response = directions_.substr(0, 1);
      name_.reference = directions_.substr(1, 1);
    } else {
      name_.sign = 1;
    }
    return name_;
  }

 private:
  // A unit stands in the last brackets, unless these hold a part or directions: Re(Hxx).
  void take_bracketed_unit() {
    const auto open = text_.find_last_of("[(");
    if (open == std::string::npos) return;
    const auto close = text_.find_first_of("])", open);
    inside_ = field_.substr(open + 1, close == std::string::npos ? close : close - open - 1);
    // `(m/s^2)/N` in brackets of the other kind, or with what follows them.
    for (const char bracket : {'[', '('}) {
      const auto from = field_.find(bracket);
      if (from == std::string::npos || from == open) continue;
      std::string whole = field_.substr(from + 1);
      if (const auto end = whole.find_last_of(bracket == '[' ? ']' : ')'); end != std::string::npos)
        whole.erase(end);
      if (frf_unit(whole)) {
        name_.unit = whole;
        text_.erase(from);
        return;
      }
    }
    if (!looks_like_unit(inside_)) return;
    name_.unit = inside_;
    text_ = text_.substr(0, open) + (close == std::string::npos ? "" : " " + text_.substr(close + 1));
  }

  // re_um_per_n.
  void take_unit_with_per() {
    constexpr std::string_view kPer = "_per_";
    const auto per = text_.find(kPer);
    if (per == std::string::npos || per == 0) return;
    const auto before = text_.find_last_of("_ ", per - 1);
    const std::size_t start = before == std::string::npos ? 0 : before + 1;
    std::string unit = text_.substr(start);
    for (auto at = unit.find(kPer); at != std::string::npos; at = unit.find(kPer))
      unit.replace(at, kPer.size(), "/");
    if (!frf_unit(unit)) return;
    name_.unit = unit;
    text_.erase(start);
  }

  // A unit without brackets, as in `Real um/N`.
  void take_unit_at_end() {
    const std::string last = field_.substr(field_.find_last_of(" _") + 1);
    if (frf_unit(last) || frequency_unit(last)) name_.unit = last;
  }

  // The part, the directions and their sign.
  void read_words() {
    for (std::size_t i = 0; i < text_.size();) {
      if (!is_alphanumeric(text_[i])) {
        // A minus before a direction turns its sign, unless it stands between two letters.
        const bool leads = i == 0 || !is_alphanumeric(text_[i - 1]);
        if (text_[i] == '-' && leads && i + 1 < text_.size() && is_direction(text_[i + 1]))
          name_.sign = -name_.sign;
        ++i;
        continue;
      }
      std::size_t end = i;
      while (end < text_.size() && is_alphanumeric(text_[end])) ++end;
      read_word(text_.substr(i, end - i));
      i = end;
    }
  }

  void read_word(std::string word) {
    if (const auto told = part_named(word)) {
      const bool only_marks_unit = told == ColumnPart::kDecibel && part_ == ColumnPart::kMagnitude;
      if (!part_ || only_marks_unit || *part_ == ColumnPart::kFrequency) part_ = told;
      return;
    }
    if (word == "deg" || word == "rad" || word == "degrees" || word == "radians") {
      name_.unit = word;
      return;
    }
    if (word.size() == 3 && (word[0] == 'h' || word[0] == 'g')) word.erase(0, 1);  // Hxy, Gxy
    if (const std::string direction = direction_named(word); !direction.empty()) word = direction;
    if (word.size() <= 2 && std::all_of(word.begin(), word.end(), is_direction)) directions_ += word;
  }

  // dB, and of what: `dB re 1 m/N`.
  void read_decibel() {
    if (!lower(name_.unit).starts_with("db")) return;
    if (part_ && part_ != ColumnPart::kMagnitude && part_ != ColumnPart::kDecibel) return;
    part_ = ColumnPart::kDecibel;
    std::string_view of = trimmed(std::string_view(name_.unit).substr(2));
    for (const std::string_view word : {"re", ":", "1"}) {
      if (of.starts_with(word)) of = trimmed(of.substr(word.size()));
    }
    name_.unit = std::string(of);
  }

  // Brackets that hold neither a part nor directions.
  bool holds_unknown_unit() const {
    const std::string low = lower(inside_);
    return !part_named(low) && !std::all_of(low.begin(), low.end(), [](char c) {
      return is_direction(c) || c == 'h' || c == ',' || c == '/' || c == '_';
    });
  }

  const std::string& field_;  // as written
  std::string text_;          // in lower case; what is left of it
  std::string inside_;        // of the last brackets, as written
  ColumnName name_;
  std::optional<ColumnPart> part_;
  std::string directions_;
};

}  // namespace

std::optional<ColumnName> column_name(const std::string& field) { return NameReader(field).read(); }

}  // namespace stablecut::document
