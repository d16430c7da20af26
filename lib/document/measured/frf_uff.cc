#include "document/measured/frf_uff.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "base/error.h"
#include "base/number_text.h"
#include "base/range.h"
#include "document/text/data_error.h"
#include "document/text/plain_text.h"

namespace stablecut::document {
namespace {

constexpr int kFrequencyResponse = 4, kCoherence = 6;
constexpr int kDisplacement = 8, kReactionForce = 9, kVelocity = 11, kAcceleration = 12, kForce = 13,
              kTime = 17, kFrequency = 18;
constexpr int kLastUnspecific = 1;  // data types 0 unknown and 1 general
constexpr std::array kTypeNames = {"general",
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
constexpr double kSameLines = 1e-5;  // of the last line: records of six digits
constexpr double kSameFactor = 1e-3;
constexpr double kPercentFrom = 1.5;  // a coherence above is none

std::string type_name(int type) {
  const bool named = type >= 0 && type < static_cast<int>(kTypeNames.size());
  return "function type " + std::to_string(type) + (named ? std::string(", ") + kTypeNames[type] : "");
}

// A function that is left out, and why: a DataError's parts.
struct Refusal {
  std::string place, value, expected;
};

struct Meaning {
  dynamics::Quantity quantity = dynamics::Quantity::kReceptance;
  double to_si = 1;
};

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

bool is_translation(int direction) { return direction >= -3 && direction <= 3; }

std::string shown_axis(const UniversalAxis& axis) {
  std::string text = "data type " + std::to_string(axis.data_type);
  if (!axis.label.empty()) text += ", " + axis.label;
  if (!axis.unit.empty()) text += ", " + axis.unit;
  return text;
}

class Collector {
 public:
  Collector(const Source& source, const FrfChoice& choice, std::vector<std::string>& remarks)
      : source_(source), choice_(choice), remarks_(remarks) {}

  dynamics::FrequencyResponse collect() {
    const std::vector<UniversalFunction> functions = chosen(read_universal_file(source_));
    std::vector<const UniversalFunction*> responses, coherences;
    std::vector<Refusal> refusals;
    for (const UniversalFunction& function : functions) {
      if (const auto refusal = refused(function)) {
        refusals.push_back(*refusal);
      } else if (choice_.node &&
                 (function.response.node != *choice_.node || function.reference.node != *choice_.node)) {
        ++elsewhere_;
      } else {
        (function.type == kCoherence ? coherences : responses).push_back(&function);
      }
    }
    if (responses.empty()) {
      if (elsewhere_ > 0) {
        throw DataError(source_.name, "", "node " + std::to_string(*choice_.node),
                        "expected a node at which both a response and a force were measured");
      }
      if (!refusals.empty())
        throw DataError(source_.name, refusals[0].place, refusals[0].value, refusals[0].expected);
      throw DataError(source_.name, coherences[0]->place(6), type_name(kCoherence),
                      "expected frequency responses too, type 4");
    }
    for (const Refusal& refusal : refusals) {
      remarks_.push_back(refusal.place + ": " + shown(refusal.value) + ": left out: " + refusal.expected);
    }
    name_places(responses);
    dynamics::FrequencyResponse frf;
    for (const UniversalFunction* function : responses) add(frf, *function);
    for (const UniversalFunction* function : coherences) add_coherence(frf, *function);
    say_once_for_all();
    return frf;
  }

 private:
  std::vector<UniversalFunction> chosen(std::vector<UniversalFunction> functions) const {
    if (choice_.functions.empty()) return functions;
    std::vector<UniversalFunction> result;
    for (const int number : choice_.functions) {
      if (number > static_cast<int>(functions.size())) {
        throw DataError(source_.name, "", "function " + std::to_string(number),
                        "expected one of the file's " + std::to_string(functions.size()) + " functions");
      }
      result.push_back(std::move(functions[number - 1]));
    }
    return result;
  }

  // Why a function is neither a frequency response nor a coherence that could be used.
  std::optional<Refusal> refused(const UniversalFunction& function) const {
    const auto refuse = [&](int record, std::string value, std::string expected) {
      return Refusal{function.place(record), std::move(value), std::move(expected)};
    };
    if (function.type != kFrequencyResponse && function.type != kCoherence && function.type != 0) {
      return refuse(6, type_name(function.type), "expected type 4, a frequency response");
    }
    const UniversalAxis& abscissa = function.abscissa_axis;
    if (abscissa.data_type != kFrequency && abscissa.data_type > kLastUnspecific) {
      return refuse(8, shown_axis(abscissa) + (abscissa.data_type == kTime ? ", a time" : ""),
                    "expected an abscissa of data type 18, frequency");
    }
    if (!abscissa.unit.empty() && !frequency_unit(abscissa.unit) &&
        (abscissa.data_type != kFrequency || physical_unit(abscissa.unit))) {
      return refuse(8, abscissa.unit, "expected an abscissa in Hz, kHz, rad/s or rpm");
    }
    if (function.type == kCoherence) return std::nullopt;
    if (!function.is_complex)
      return refuse(7, "real numbers", "expected complex ones, ordinate data type 5 or 6");
    if (function.type == 0 && function.denominator.data_type != kForce &&
        !labelled_unit(function.ordinate, {}))
      return refuse(6, type_name(0), "expected type 4, a frequency response, or a response over a force");
    for (const auto& [side, name] :
         {std::pair(&function.response, "response"), std::pair(&function.reference, "reference")}) {
      if (!is_translation(side->direction)) {
        return refuse(6, std::string(name) + " direction " + std::to_string(side->direction),
                      "expected a translation, 1 to 3 (along x, y, z) or negative");
      }
    }
    const UniversalAxis& denominator = function.denominator;
    if (denominator.data_type > kLastUnspecific && denominator.data_type != kForce &&
        denominator.data_type != kReactionForce) {
      return refuse(10, shown_axis(denominator), "expected a force below the response, data type 13");
    }
    if (choice_.unit || choice_.quantity) return std::nullopt;
    const UniversalAxis& response = function.ordinate;
    if (!quantity_of(response) &&
        (response.data_type > kLastUnspecific || !labelled_unit(response, denominator))) {
      return refuse(9, shown_axis(response),
                    response.data_type > kLastUnspecific
                        ? "expected a displacement, velocity or acceleration, data type 8, 11 or 12"
                        : "does not say what the response is: expected --quantity or --unit");
    }
    return std::nullopt;
  }

  Meaning meaning_of(const UniversalFunction& function) {
    const UniversalAxis& response = function.ordinate;
    const auto labelled = labelled_unit(response, function.denominator);
    Meaning meaning;
    const auto typed = quantity_of(response);
    meaning.quantity = typed ? *typed : labelled ? labelled->quantity : dynamics::Quantity::kReceptance;
    if (choice_.unit) {
      meaning = {choice_.unit->quantity, choice_.unit->to_si};
      return meaning;
    }
    if (choice_.quantity) {
      if ((typed || labelled) && meaning.quantity != *choice_.quantity)
        say(function.place(9) + ": " + shown(shown_axis(response)) + ": read as --quantity says");
      meaning.quantity = *choice_.quantity;
    }
    const bool label_fits = labelled && labelled->quantity == meaning.quantity;
    if (labelled && !label_fits && !choice_.quantity) {
      say(function.place(9) + ": " + shown(shown_axis(response)) +
          ": the unit is none of that data type: the type is believed");
    }
    const std::string units =
        shown(response.unit) + " over " +
        (function.denominator.unit.empty() ? "a force" : shown(function.denominator.unit));
    if (function.units) {
      if (!labelled && !response.unit.empty())
        say(function.place(9) + ": " + units + ": not known as a unit: dataset 164 is believed (--unit)");
      meaning.to_si = function.units->force_factor / function.units->length_factor;
      if (label_fits && std::abs(labelled->to_si / meaning.to_si - 1) > kSameFactor) {
        if (is_in_g(response)) {
          meaning.to_si = labelled->to_si;
          say(function.place(9) + ": " + units +
              ": taken with a g of 9.80665 m/s^2, which dataset 164 cannot say");
        } else {
          say(function.place(9) + ": " + units + ": dataset 164 says otherwise, and is believed (--unit)");
        }
      }
    } else if (label_fits) {
      meaning.to_si = labelled->to_si;
    } else if (!response.unit.empty() || !function.denominator.unit.empty()) {
      say(function.place(9) + ": " + units +
          ": not known as a unit, and there is no dataset 164: taken as SI (--unit)");
    } else {
      without_unit_ = true;
    }
    return meaning;
  }

  Eigen::VectorXd lines_of(const UniversalFunction& function) {
    const std::string& unit = function.abscissa_axis.unit;
    if (!unit.empty() && !frequency_unit(unit))
      say(function.place(8) + ": " + shown(unit) + ": not known as a unit of frequency: taken as Hz");
    const double to_hz = frequency_unit(function.abscissa_axis.unit).value_or(1);
    Eigen::VectorXd lines = to_hz * function.abscissa;
    for (Eigen::Index i = 0; i < lines.size(); ++i) {
      if (lines[i] >= 0 && std::isfinite(lines[i]) && (i == 0 || lines[i] > lines[i - 1])) continue;
      throw DataError(source_.name, function.place(i == 0 ? 7 : 12), number_text(lines[i]) + " Hz",
                      "expected increasing frequencies, none below 0 Hz");
    }
    return lines;
  }

  void check_lines(const dynamics::FrequencyResponse& frf, const UniversalFunction& function,
                   const Eigen::VectorXd& lines) const {
    const Eigen::VectorXd& known = frf.frequency_hz;
    if (lines.size() == known.size() &&
        (lines - known).cwiseAbs().maxCoeff() <= kSameLines * known[known.size() - 1])
      return;
    throw DataError(source_.name, function.place(7), lines_text(lines),
                    "expected the " + std::to_string(known.size()) +
                        " lines of the functions before (--functions LIST takes some of them)");
  }

  // Names of directions with their node where there are several nodes.
  void name_places(const std::vector<const UniversalFunction*>& responses) {
    std::vector<int> response_nodes, reference_nodes;
    const auto note = [](std::vector<int>& nodes, int node) {
      if (std::find(nodes.begin(), nodes.end(), node) == nodes.end()) nodes.push_back(node);
    };
    for (const auto* function : responses) {
      note(response_nodes, function->response.node);
      note(reference_nodes, function->reference.node);
    }
    with_nodes_ = response_nodes.size() > 1 || reference_nodes.size() > 1;
    if (with_nodes_) {
      remarks_.push_back("responses at " + std::to_string(response_nodes.size()) + " and forces at " +
                         std::to_string(reference_nodes.size()) +
                         " nodes: a direction is named with its node, as x@" +
                         std::to_string(response_nodes[0]) + " (--node N takes what was measured at one)");
    } else if (response_nodes[0] != reference_nodes[0]) {
      remarks_.push_back("responses at node " + std::to_string(response_nodes[0]) + ", forces at node " +
                         std::to_string(reference_nodes[0]) + ": taken for the same place");
    }
  }

  // The direction's name; `sign` is turned by a negative one.
  std::string direction_name(const UniversalDof& dof, double& sign) {
    static constexpr std::array kNames = {"x", "x", "y", "z"};
    if (dof.direction < 0) sign = -sign;
    if (dof.direction == 0) without_direction_ = true;
    const std::string name = kNames[std::abs(dof.direction)];
    return with_nodes_ ? name + "@" + std::to_string(dof.node) : name;
  }

  void add(dynamics::FrequencyResponse& frf, const UniversalFunction& function) {
    const Eigen::VectorXd lines = lines_of(function);
    const Meaning meaning = meaning_of(function);
    if (frf.entries.empty()) {
      frf.frequency_hz = lines;
      frf.quantity = meaning.quantity;
    }
    check_lines(frf, function, lines);
    if (meaning.quantity != frf.quantity) {
      throw DataError(source_.name, function.place(9), shown_axis(function.ordinate),
                      "expected the quantity of the functions before");
    }
    double factor = meaning.to_si;
    dynamics::FrequencyResponseEntry entry;
    entry.response = direction_name(function.response, factor);
    entry.reference = direction_name(function.reference, factor);
    for (std::size_t e = 0; e < frf.entries.size(); ++e) {
      if (!frf.entries[e].same_places(entry)) continue;
      throw DataError(
          source_.name, function.place(6), entry.response + entry.reference,
          "measured in function " + std::to_string(numbers_[e]) +
              " too: expected each pair of directions once (--functions LIST takes some of them)");
    }
    entry.h = factor * function.values;
    for (Eigen::Index i = 0; i < entry.h.size(); ++i) {
      if (std::isfinite(entry.h[i].real()) && std::isfinite(entry.h[i].imag())) continue;
      // At 0 Hz, where nothing is learnt, many programs divide by zero.
      if (lines[i] > 0) {
        throw DataError(source_.name, function.place(12), "line at " + number_text(lines[i]) + " Hz",
                        "expected a finite number");
      }
      entry.h[i] = 0;
    }
    frf.entries.push_back(std::move(entry));
    numbers_.push_back(function.number);
  }

  void add_coherence(dynamics::FrequencyResponse& frf, const UniversalFunction& function) {
    if (!is_translation(function.response.direction) || !is_translation(function.reference.direction)) return;
    double sign = 1;
    dynamics::FrequencyResponseEntry wanted;
    wanted.response = direction_name(function.response, sign);
    wanted.reference = direction_name(function.reference, sign);
    const auto entry = std::find_if(frf.entries.begin(), frf.entries.end(),
                                    [&](const auto& candidate) { return candidate.same_places(wanted); });
    if (entry == frf.entries.end()) return;
    check_lines(frf, function, lines_of(function));
    entry->coherence =
        function.values.real().array().isFinite().select(function.values.real(), 0.0).cwiseMax(0);
    const double largest = entry->coherence.maxCoeff();
    if (largest > kPercentFrom) {
      say(function.place(12) + ": coherences up to " + number_text(largest) + ": taken as percent");
      entry->coherence /= 100;
    }
    entry->coherence = entry->coherence.cwiseMin(1).eval();
    entry->averages = choice_.averages;
  }

  void say(const std::string& remark) {
    // Once is enough: functions of one file are mostly alike.
    const std::string what = remark.substr(remark.find("): ") + 1);
    if (std::find(said_.begin(), said_.end(), what) != said_.end()) return;
    said_.push_back(what);
    remarks_.push_back(remark);
  }

  void say_once_for_all() {
    if (without_unit_) remarks_.push_back("no unit, and no dataset 164: taken as SI (--unit)");
    if (without_direction_) remarks_.push_back("directions 0, which are none: taken as x");
  }

  const Source& source_;
  const FrfChoice& choice_;
  std::vector<std::string>& remarks_;
  std::vector<std::string> said_;
  std::vector<int> numbers_;  // of the functions behind the entries
  int elsewhere_ = 0;
  bool with_nodes_ = false, without_unit_ = false, without_direction_ = false;
};

// `x@3` -> node 3, direction 1.
UniversalDof dof_of(const std::string& name) {
  const auto at = name.find('@');
  const std::string direction = name.substr(0, at);
  const auto node =
      at == std::string::npos ? std::optional(1) : parse_integer(std::string_view(name).substr(at + 1));
  const auto index = std::string("xyz").find(direction);
  if (direction.size() != 1 || index == std::string::npos || !node)
    throw InvalidArgument(name + ": a universal file takes the directions x, y and z");
  return {"", *node, static_cast<int>(index) + 1};
}

}  // namespace

dynamics::FrequencyResponse frf_from_universal_file(const Source& source, const FrfChoice& choice,
                                                    std::vector<std::string>& remarks) {
  return Collector(source, choice, remarks).collect();
}

std::string frf_to_universal_file(const dynamics::FrequencyResponse& frf, UniversalForm form) {
  static const std::array<UniversalAxis, 3> kResponses = {{{kDisplacement, "Displacement", "m"},
                                                           {kVelocity, "Velocity", "m/s"},
                                                           {kAcceleration, "Acceleration", "m/s^2"}}};
  std::string text = universal_si_units();
  for (const auto& entry : frf.entries) {
    if (entry.response_position_m.value_or(0) != 0 || entry.reference_position_m.value_or(0) != 0)
      throw InvalidArgument(
          "entries at several distances from the tip: a universal file takes directions only");
    UniversalFunction function;
    function.id[0] = "H " + entry.response + " " + entry.reference + ": response, then force";
    function.type = kFrequencyResponse;
    function.response = dof_of(entry.response);
    function.reference = dof_of(entry.reference);
    function.abscissa = frf.frequency_hz;
    function.values = entry.h;
    function.abscissa_axis = {kFrequency, "Frequency", "Hz"};
    function.ordinate = kResponses[static_cast<std::size_t>(frf.quantity)];
    function.denominator = {kForce, "Force", "N"};
    text += universal_function(function, form);
  }
  return text;
}

}  // namespace stablecut::document
