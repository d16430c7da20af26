#include "document/measured/universal_meaning.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <initializer_list>
#include <utility>

#include "document/text/plain_text.h"

namespace stablecut::document {
namespace {

using namespace universal;

constexpr double kSameFactor = 1e-3;  // units of a label and of dataset 164 that are one

bool mentions(const std::string& text, std::initializer_list<const char*> words) {
  const std::string low = lower(text);
  return std::any_of(words.begin(), words.end(),
                     [&](const char* word) { return low.find(word) != std::string::npos; });
}

// Quantity of the response by its data type, else by words in its label.
std::optional<dynamics::Quantity> quantity_of(const UniversalAxis& axis) {
  if (axis.data_type == kDisplacement) return dynamics::Quantity::kReceptance;
  if (axis.data_type == kVelocity) return dynamics::Quantity::kMobility;
  if (axis.data_type == kAcceleration) return dynamics::Quantity::kAccelerance;
  if (axis.data_type > kLastUnspecific) return std::nullopt;
  if (mentions(axis.label, {"accel", "inertance"})) return dynamics::Quantity::kAccelerance;
  if (mentions(axis.label, {"veloc", "mobility"})) return dynamics::Quantity::kMobility;
  if (mentions(axis.label, {"displ", "receptance", "compliance"})) return dynamics::Quantity::kReceptance;
  return std::nullopt;
}

// The unit of response over force that the labels tell, together or each alone; a force without a unit is in
// newtons.
std::optional<FrfUnit> labelled_unit(const UniversalAxis& response, const UniversalAxis& force) {
  const auto upper = physical_unit(response.unit);
  if (!upper) return std::nullopt;
  if (const auto whole = frf_unit(*upper)) return whole;
  PhysicalUnit lower_unit{1, 0, 0, 1};
  if (!force.unit.empty()) {
    const auto told = physical_unit(force.unit);
    if (!told) return std::nullopt;
    lower_unit = *told;
  }
  return frf_unit(PhysicalUnit{upper->to_si / lower_unit.to_si, upper->length - lower_unit.length,
                               upper->time - lower_unit.time, upper->force - lower_unit.force});
}

// 164's units have no g: a label with a g means it.
bool is_in_g(const UniversalAxis& response) {
  if (!physical_unit(response.unit)) return false;
  std::string word;
  for (const char c : lower(plain_signs(response.unit)) + ' ') {
    if (c == '\'') continue;
    if (std::isalpha(static_cast<unsigned char>(c))) {
      word += c;
    } else {
      if (word == "g" || word == "gn" || word == "gs") return true;
      word.clear();
    }
  }
  return false;
}

std::string units_text(const UniversalFunction& function) {
  const std::string& force = function.denominator.unit;
  return function.ordinate.unit + " over " + (force.empty() ? "a force" : force);
}

Remark remark_on(const UniversalFunction& function, int record, RemarkKind kind, std::string written,
                 std::vector<double> numbers = {}) {
  return {kind, "", function.place(record), std::move(written), "", std::move(numbers)};
}

Remark remark_on_type(const UniversalFunction& function, int record, RemarkKind kind,
                      const UniversalAxis& axis) {
  return remark_on(function, record, kind, axis_text(axis), {static_cast<double>(axis.data_type)});
}

// Why the abscissa is none of frequencies.
std::optional<Remark> why_no_frequency(const UniversalFunction& function) {
  const UniversalAxis& abscissa = function.abscissa_axis;
  if (abscissa.data_type != kFrequency && abscissa.data_type > kLastUnspecific) {
    Remark remark = remark_on_type(function, 8, RemarkKind::kAbscissaNoFrequency, abscissa);
    if (abscissa.data_type == kTime) remark.written += ", a time";
    return remark;
  }
  const bool known = abscissa.unit.empty() || frequency_unit(abscissa.unit);
  if (!known && (abscissa.data_type != kFrequency || physical_unit(abscissa.unit)))
    return remark_on(function, 8, RemarkKind::kAbscissaUnitNoFrequency, abscissa.unit);
  return std::nullopt;
}

std::optional<Remark> why_no_translation(const UniversalFunction& function) {
  for (const auto& [dof, name] :
       {std::pair(&function.response, "response"), std::pair(&function.reference, "reference")}) {
    if (dof->is_translation()) continue;
    return remark_on(function, 6, RemarkKind::kRotation,
                     std::string(name) + " direction " + std::to_string(dof->direction),
                     {static_cast<double>(dof->direction)});
  }
  return std::nullopt;
}

// Why it is no displacement, velocity or acceleration over a force, where the user does not say that it is.
std::optional<Remark> why_no_motion(const UniversalFunction& function) {
  const UniversalAxis& response = function.ordinate;
  if (quantity_of(response)) return std::nullopt;
  if (response.data_type > kLastUnspecific)
    return remark_on_type(function, 9, RemarkKind::kResponseNoMotion, response);
  if (labelled_unit(response, function.denominator)) return std::nullopt;
  return remark_on_type(function, 9, RemarkKind::kResponseUnknown, response);
}

// The factor to SI, where the user chose none. The label's unit counts where it fits the quantity.
double factor_to_si(const UniversalFunction& function, const std::optional<FrfUnit>& label, bool fits,
                    const TakeRemark& remark) {
  const auto say = [&](RemarkKind kind) { remark(remark_on(function, 9, kind, units_text(function))); };
  const bool has_unit = !function.ordinate.unit.empty();
  if (function.units) {
    const double by_dataset = function.units->force_factor / function.units->length_factor;
    if (!label && has_unit) say(RemarkKind::kUnitUnknown);
    if (!fits || std::abs(label->to_si / by_dataset - 1) <= kSameFactor) return by_dataset;
    const bool in_g = is_in_g(function.ordinate);
    say(in_g ? RemarkKind::kUnitInG : RemarkKind::kUnitContradicted);
    return in_g ? label->to_si : by_dataset;
  }
  if (fits) return label->to_si;
  if (has_unit || !function.denominator.unit.empty())
    say(RemarkKind::kUnitUnknownTakenAsSi);
  else
    remark({RemarkKind::kUnitMissing, "", {}, "", "", {}});
  return 1;
}

}  // namespace

std::string function_type_text(int type) {
  static constexpr std::array kNames = {"general",
                                        "a time response",
                                        "an auto spectrum",
                                        "a cross spectrum",
                                        "a frequency response",
                                        "a transmissibility",
                                        "a coherence",
                                        "an autocorrelation",
                                        "a cross correlation",
                                        "a power spectral density",
                                        "an energy spectral density",
                                        "a probability density",
                                        "a spectrum"};
  const bool named = type >= 0 && type < static_cast<int>(kNames.size());
  return "function type " + std::to_string(type) + (named ? std::string(", ") + kNames[type] : "");
}

std::string axis_text(const UniversalAxis& axis) {
  std::string text = "data type " + std::to_string(axis.data_type);
  if (!axis.label.empty()) text += ", " + axis.label;
  if (!axis.unit.empty()) text += ", " + axis.unit;
  return text;
}

std::optional<Remark> why_left_out(const UniversalFunction& function, const FrfChoice& choice) {
  const auto wrong_type = [&](RemarkKind kind) {
    return remark_on(function, 6, kind, function_type_text(function.type),
                     {static_cast<double>(function.type)});
  };
  if (function.type != kFrequencyResponse && function.type != kCoherence && function.type != kGeneral)
    return wrong_type(RemarkKind::kNoFrequencyResponse);
  if (auto remark = why_no_frequency(function)) return remark;
  if (function.type == kCoherence) return std::nullopt;
  if (!function.is_complex) return remark_on(function, 7, RemarkKind::kRealNumbers, "real numbers");
  const UniversalAxis& force = function.denominator;
  if (function.type == kGeneral && force.data_type != kForce && !labelled_unit(function.ordinate, {}))
    return wrong_type(RemarkKind::kNoResponseOverForce);
  if (auto remark = why_no_translation(function)) return remark;
  if (force.data_type > kLastUnspecific && force.data_type != kForce && force.data_type != kReactionForce)
    return remark_on_type(function, 10, RemarkKind::kDenominatorNoForce, force);
  if (choice.unit || choice.quantity) return std::nullopt;
  return why_no_motion(function);
}

FrfUnit meaning_of(const UniversalFunction& function, const FrfChoice& choice, const TakeRemark& remark) {
  if (choice.unit) return *choice.unit;
  const UniversalAxis& response = function.ordinate;
  const auto say = [&](RemarkKind kind) { remark(remark_on_type(function, 9, kind, response)); };
  const std::optional<FrfUnit> label = labelled_unit(response, function.denominator);
  const auto typed = quantity_of(response);
  FrfUnit meaning;
  meaning.quantity = typed ? *typed : label ? label->quantity : dynamics::Quantity::kReceptance;
  if (choice.quantity) {
    if ((typed || label) && meaning.quantity != *choice.quantity) say(RemarkKind::kQuantityOverruled);
    meaning.quantity = *choice.quantity;
  }
  const bool fits = label && label->quantity == meaning.quantity;
  if (label && !fits && !choice.quantity) say(RemarkKind::kUnitOfOtherQuantity);
  meaning.to_si = factor_to_si(function, label, fits, remark);
  return meaning;
}

double factor_to_hz(const UniversalFunction& function, const TakeRemark& remark) {
  const std::string& unit = function.abscissa_axis.unit;
  const auto factor = frequency_unit(unit);
  if (!factor && !unit.empty()) remark(remark_on(function, 8, RemarkKind::kFrequencyUnitUnknown, unit));
  return factor.value_or(1);
}

}  // namespace stablecut::document
