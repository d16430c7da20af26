#include "document/measured/frf_column_name.h"

#include <algorithm>
#include <cctype>
#include <map>

#include "document/measured/frf_unit.h"
#include "document/text/plain_text.h"

namespace stablecut::document {
namespace {

bool is_direction(char c) { return c == 'x' || c == 'y' || c == 'z'; }

std::optional<ColumnPart> part_named(const std::string& word) {
  static const std::map<std::string, ColumnPart> kWords = {{"frequenz", ColumnPart::kFrequency},
                                                           {"frequence", ColumnPart::kFrequency},
                                                           {"realteil", ColumnPart::kReal},
                                                           {"imagin", ColumnPart::kImaginary},
                                                           {"imaginaerteil", ColumnPart::kImaginary},
                                                           {"betrag", ColumnPart::kMagnitude},
                                                           {"f", ColumnPart::kFrequency},
                                                           {"freq", ColumnPart::kFrequency},
                                                           {"frequency", ColumnPart::kFrequency},
                                                           {"hz", ColumnPart::kFrequency},
                                                           {"khz", ColumnPart::kFrequency},
                                                           {"omega", ColumnPart::kFrequency},
                                                           {"re", ColumnPart::kReal},
                                                           {"real", ColumnPart::kReal},
                                                           {"im", ColumnPart::kImaginary},
                                                           {"imag", ColumnPart::kImaginary},
                                                           {"imaginary", ColumnPart::kImaginary},
                                                           {"mag", ColumnPart::kMagnitude},
                                                           {"magnitude", ColumnPart::kMagnitude},
                                                           {"abs", ColumnPart::kMagnitude},
                                                           {"amp", ColumnPart::kMagnitude},
                                                           {"ampl", ColumnPart::kMagnitude},
                                                           {"amplitude", ColumnPart::kMagnitude},
                                                           {"modulus", ColumnPart::kMagnitude},
                                                           {"gain", ColumnPart::kMagnitude},
                                                           {"phase", ColumnPart::kPhase},
                                                           {"ph", ColumnPart::kPhase},
                                                           {"phi", ColumnPart::kPhase},
                                                           {"arg", ColumnPart::kPhase},
                                                           {"angle", ColumnPart::kPhase},
                                                           {"db", ColumnPart::kDecibel},
                                                           {"coh", ColumnPart::kCoherence},
                                                           {"coherence", ColumnPart::kCoherence}};
  const auto found = kWords.find(word);
  return found == kWords.end() ? std::nullopt : std::optional(found->second);
}

// A unit, known or not; neither a part nor directions, as in Re(Hxx) or H(x/y).
bool looks_like_unit(const std::string& text) {
  const std::string low = lower(text);
  for (const char* word : {"db", "deg", "degrees", "rad", "radians", "\xC2\xB0", "\xB0", "-"}) {
    if (low == word) return true;
  }
  const bool quotient = low.find('/') != std::string::npos && std::any_of(low.begin(), low.end(), [](char c) {
                          return std::isalpha(static_cast<unsigned char>(c)) && !is_direction(c);
                        });
  return quotient || physical_unit(text) || frequency_unit(text);
}

}  // namespace

std::optional<ColumnName> column_name(const std::string& field) {
  ColumnName name;
  std::string text = lower(field);
  std::string inside;  // the last brackets
  // A unit stands in the last brackets, unless these hold a part or directions: Re(Hxx).
  const auto open = text.find_last_of("[(");
  if (open != std::string::npos) {
    const auto close = text.find_first_of("])", open);
    inside = field.substr(open + 1, close == std::string::npos ? close : close - open - 1);
    // `(m/s^2)/N` in brackets of the other kind, or with what follows them.
    for (const char* outer : {"[", "("}) {
      const auto from = field.find(outer);
      if (from == std::string::npos || from == open) continue;
      std::string whole = field.substr(from + 1);
      if (const auto end = whole.find_last_of(*outer == '[' ? ']' : ')'); end != std::string::npos)
        whole.erase(end);
      if (frf_unit(whole)) {
        name.unit = whole;
        text.erase(from);
        break;
      }
    }
    if (name.unit.empty() && looks_like_unit(inside)) {
      name.unit = inside;
      text = text.substr(0, open) + (close == std::string::npos ? "" : " " + text.substr(close + 1));
    }
  }
  // re_um_per_n.
  if (const auto per = text.find("_per_"); name.unit.empty() && per != std::string::npos && per > 0) {
    const auto before = text.find_last_of("_ ", per - 1);
    const std::size_t start = before == std::string::npos ? 0 : before + 1;
    std::string unit = text.substr(start);
    for (auto at = unit.find("_per_"); at != std::string::npos; at = unit.find("_per_"))
      unit.replace(at, 5, "/");
    if (frf_unit(unit)) {
      name.unit = unit;
      text.erase(start);
    }
  }
  if (name.unit.empty()) {
    // A unit without brackets, as in `Real um/N`.
    const std::string last = field.substr(field.find_last_of(" _") + 1);
    if (frf_unit(last) || frequency_unit(last)) name.unit = last;
  }
  std::optional<ColumnPart> part;
  std::string directions;
  double sign = 1;
  for (std::size_t i = 0; i < text.size();) {
    if (!std::isalnum(static_cast<unsigned char>(text[i]))) {
      // A minus before a direction turns its sign, unless it stands between two letters.
      const bool leads = i == 0 || !std::isalnum(static_cast<unsigned char>(text[i - 1]));
      if (text[i] == '-' && leads && i + 1 < text.size() && is_direction(text[i + 1])) sign = -sign;
      ++i;
      continue;
    }
    std::size_t end = i;
    while (end < text.size() && std::isalnum(static_cast<unsigned char>(text[end]))) ++end;
    std::string word = text.substr(i, end - i);
    i = end;
    if (const auto told = part_named(word)) {
      const bool only_marks_unit = told == ColumnPart::kDecibel && part == ColumnPart::kMagnitude;
      if (!part || only_marks_unit || *part == ColumnPart::kFrequency) part = told;
      continue;
    }
    if (word == "deg" || word == "rad" || word == "degrees" || word == "radians") {
      name.unit = word;
      continue;
    }
    if (word.size() == 3 && (word[0] == 'h' || word[0] == 'g')) word.erase(0, 1);
    const bool all = word.size() <= 2 && std::all_of(word.begin(), word.end(), is_direction);
    if (all) directions += word;
  }
  // dB, and of what: `dB re 1 m/N`.
  if (lower(name.unit).starts_with("db") &&
      (!part || part == ColumnPart::kMagnitude || part == ColumnPart::kDecibel)) {
    part = ColumnPart::kDecibel;
    std::string_view of = trimmed(std::string_view(name.unit).substr(2));
    for (const std::string_view word : {"re", ":", "1"}) {
      if (of.starts_with(word)) of = trimmed(of.substr(word.size()));
    }
    name.unit = std::string(of);
  }
  const auto is_side = [](char c) { return is_direction(c) || c == 'h' || c == ',' || c == '/' || c == '_'; };
  if (part == ColumnPart::kPhase && name.unit.empty() && !part_named(lower(inside)) &&
      !std::all_of(inside.begin(), inside.end(), [&](char c) { return is_side(lower({c})[0]); }))
    name.unit = inside;  // none that is known
  if (!part && frequency_unit(name.unit)) part = ColumnPart::kFrequency;
  if (!part) return std::nullopt;
  if (part == ColumnPart::kFrequency && (text.starts_with("omega") || lower(name.unit) == "rad"))
    name.unit = "rad/s";
  name.part = *part;
  if (directions.size() == 2) {
    name.response = directions.substr(0, 1);
    name.reference = directions.substr(1, 1);
    name.sign = sign;
  }
  return name;
}

}  // namespace stablecut::document
