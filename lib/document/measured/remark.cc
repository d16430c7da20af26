#include "document/measured/remark.h"

#include <array>
#include <cmath>
#include <string_view>

#include "base/number_text.h"

namespace stablecut::document {
namespace {

// The words behind file and place. {written}, {entry} and {1}, {2}, {3} stand for the remark's own. Of a
// function that is left out: what was expected in place of what is written.
struct Sentence {
  RemarkKind kind;
  const char* words;
  Remedy remedy = Remedy::kNone;
};

constexpr std::array kSentences = {
    // Functions that are left out.
    Sentence{RemarkKind::kNoFrequencyResponse, "expected type 4, a frequency response"},
    Sentence{RemarkKind::kNoResponseOverForce,
             "expected type 4, a frequency response, or a response over a force"},
    Sentence{RemarkKind::kAbscissaNoFrequency, "expected an abscissa of data type 18, frequency"},
    Sentence{RemarkKind::kAbscissaUnitNoFrequency, "expected an abscissa in Hz, kHz, rad/s or rpm"},
    Sentence{RemarkKind::kRealNumbers, "expected complex ones, ordinate data type 5 or 6"},
    Sentence{RemarkKind::kRotation, "expected a translation, 1 to 3 (along x, y, z) or negative"},
    Sentence{RemarkKind::kDenominatorNoForce, "expected a force as the denominator, data type 13"},
    Sentence{RemarkKind::kResponseNoMotion,
             "expected a displacement, velocity or acceleration, data type 8, 11 or 12"},
    Sentence{RemarkKind::kResponseUnknown, "does not say what the response is", Remedy::kQuantityOrUnit},

    // Quantity and unit, nodes and directions.
    Sentence{RemarkKind::kQuantityOverruled, "{written}: the chosen quantity is believed", Remedy::kQuantity},
    Sentence{RemarkKind::kUnitOverruled,
             "the unit belongs to another quantity than the chosen one, which is believed",
             Remedy::kQuantity},
    Sentence{RemarkKind::kUnitOfOtherQuantity,
             "{written}: the unit does not belong to that data type, which is believed"},
    Sentence{RemarkKind::kUnitUnknown, "{written}: not known as a unit: dataset 164 is believed",
             Remedy::kUnit},
    Sentence{RemarkKind::kUnitUnknownTakenAsSi,
             "{written}: not known as a unit of that quantity, and there is no dataset 164: taken as SI",
             Remedy::kUnit},
    Sentence{RemarkKind::kUnitInG,
             "{written}: taken with a g of 9.80665 m/s^2, which dataset 164 cannot say"},
    Sentence{RemarkKind::kUnitContradicted, "{written}: dataset 164 says otherwise, and is believed",
             Remedy::kUnit},
    Sentence{RemarkKind::kUnitMissing, "no unit, and no dataset 164: taken as SI", Remedy::kUnit},
    Sentence{RemarkKind::kFrequencyUnitUnknown, "{written}: not known as a unit of frequency: taken as Hz"},
    Sentence{RemarkKind::kPhaseTakenAsRadians,
             "the phase of {entry} has no unit: up to {1}, taken as radians"},
    Sentence{RemarkKind::kPhaseTakenAsDegrees,
             "the phase of {entry} has no unit: up to {1}, taken as degrees"},
    Sentence{RemarkKind::kCoherenceTakenAsPercent, "coherences up to {1}: taken as percent"},
    Sentence{RemarkKind::kSeveralNodes,
             "responses at {1} and forces at {2} nodes: a direction is named with its node, as x@{3}",
             Remedy::kNode},
    Sentence{RemarkKind::kTwoNodes, "responses at node {1}, forces at node {2}: taken for the same place"},
    Sentence{RemarkKind::kDirectionMissing, "directions 0, which are none: taken as x"},
    Sentence{RemarkKind::kDirectionsOverruled, "says {written}: taken for {entry}"},

    // Records of taps.
    Sentence{RemarkKind::kMotionTaken, "does not say what the responses are: taken as accelerations in m/s^2",
             Remedy::kQuantityOrUnit},
    Sentence{RemarkKind::kForceUnitMissing, "no unit of the force: taken as N", Remedy::kUnit},
    Sentence{RemarkKind::kResponsesTakenAs, "responses without directions: taken along {written}"},
    Sentence{RemarkKind::kForceOverruled, "says a force along {written}: taken along {entry}"},
};
constexpr RemarkKind kLastLeftOut = RemarkKind::kResponseUnknown;
constexpr RemarkKind kLast = RemarkKind::kForceOverruled;

// Every kind has its row, in the order of the kinds.
constexpr bool in_order() {
  for (std::size_t i = 0; i < kSentences.size(); ++i) {
    if (static_cast<std::size_t>(kSentences[i].kind) != i) return false;
  }
  return kSentences.size() == static_cast<std::size_t>(kLast) + 1;
}
static_assert(in_order());

const Sentence& sentence_of(RemarkKind kind) { return kSentences[static_cast<std::size_t>(kind)]; }

// Counts and nodes with all their digits.
std::string number_or_count(double value) { return number_text(value, value == std::floor(value) ? 10 : 6); }

// What stands for a name in braces.
std::string value_of(std::string_view name, const Remark& remark) {
  if (name == "written") return shown(remark.written);
  if (name == "entry") return remark.entry;
  const auto index = static_cast<std::size_t>(name[0] - '1');
  return index < remark.numbers.size() ? number_or_count(remark.numbers[index]) : "?";
}

std::string sentence(const Remark& remark) {
  std::string text = remark.kind <= kLastLeftOut ? "{written}: left out: " : "";
  text += sentence_of(remark.kind).words;
  std::string result;
  for (std::string_view rest = text; !rest.empty();) {
    const auto open = rest.find('{');
    result += rest.substr(0, open);
    if (open == std::string_view::npos) break;
    const auto close = rest.find('}', open);
    result += value_of(rest.substr(open + 1, close - open - 1), remark);
    rest.remove_prefix(close + 1);
  }
  return result;
}

}  // namespace

std::string FilePlace::text() const {
  if (line == 0) return "";
  if (function == 0) return line_place(line);
  return line_place(line) + " (function " + std::to_string(function) + ", record " + std::to_string(record) +
         ")";
}

std::string remark_text(const Remark& remark) {
  std::string text;
  for (const std::string& part : {remark.file, remark.place.text()}) {
    if (!part.empty()) text += part + ": ";
  }
  return text + sentence(remark);
}

Remedy remedy(RemarkKind kind) { return sentence_of(kind).remedy; }

bool same_but_for_place(const Remark& a, const Remark& b) { return sentence(a) == sentence(b); }

DataError left_out_error(const Remark& remark) {
  return DataError(remark.file, remark.place.text(), remark.written, sentence_of(remark.kind).words,
                   remedy(remark.kind));
}

}  // namespace stablecut::document
