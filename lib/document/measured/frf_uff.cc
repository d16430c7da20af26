#include "document/measured/frf_uff.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/number_text.h"
#include "document/measured/universal_file.h"
#include "document/measured/universal_meaning.h"
#include "document/text/data_error.h"

namespace stablecut::document {
namespace {

constexpr double kSameLines = 1e-5;   // of the last line: records of six digits
constexpr double kPercentFrom = 1.5;  // a coherence above is none

using Functions = std::vector<UniversalFunction>;

class Collector {
 public:
  Collector(const Source& source, const FrfChoice& choice, std::vector<Remark>& remarks)
      : source_(source),
        choice_(choice),
        remarks_(remarks),
        take_remark_([this](Remark remark) { say(std::move(remark)); }) {}

  dynamics::FrequencyResponse collect() {
    const Functions functions = chosen(read_universal_file(source_));
    sort_out(functions);
    if (responses_.empty()) refuse();
    for (const Remark& remark : left_out_) remarks_.push_back(remark);
    note_nodes();
    dynamics::FrequencyResponse frf;
    for (const UniversalFunction* function : responses_) add(frf, *function);
    for (const UniversalFunction* function : coherences_) add_coherence(frf, *function);
    return frf;
  }

 private:
  Functions chosen(Functions functions) const {
    if (choice_.functions.empty()) return functions;
    Functions result;
    for (const int number : choice_.functions) {
      if (number > static_cast<int>(functions.size())) {
        throw DataError(source_.name, "", "function " + std::to_string(number),
                        "expected one of the file's " + std::to_string(functions.size()) + " functions");
      }
      result.push_back(std::move(functions[number - 1]));
    }
    return result;
  }

  void sort_out(const Functions& functions) {
    for (const UniversalFunction& function : functions) {
      if (auto remark = why_left_out(function, choice_)) {
        remark->file = source_.name;
        left_out_.push_back(std::move(*remark));
      } else if (choice_.node &&
                 (function.response.node != *choice_.node || function.reference.node != *choice_.node)) {
        ++elsewhere_;
      } else {
        (function.type == universal::kCoherence ? coherences_ : responses_).push_back(&function);
      }
    }
  }

  // Without a frequency response.
  [[noreturn]] void refuse() const {
    if (elsewhere_ > 0) {
      throw DataError(source_.name, "", "node " + std::to_string(*choice_.node),
                      "expected a node at which both a response and a force were measured");
    }
    if (!left_out_.empty()) throw left_out_error(left_out_[0]);
    throw DataError(source_.name, coherences_[0]->place(6).text(), function_type_text(universal::kCoherence),
                    "expected frequency responses too, type 4");
  }

  // Directions are named with their node where there are several nodes.
  void note_nodes() {
    std::vector<int> response_nodes, reference_nodes;
    const auto note = [](std::vector<int>& nodes, int node) {
      if (std::find(nodes.begin(), nodes.end(), node) == nodes.end()) nodes.push_back(node);
    };
    for (const auto* function : responses_) {
      note(response_nodes, function->response.node);
      note(reference_nodes, function->reference.node);
    }
    with_nodes_ = response_nodes.size() > 1 || reference_nodes.size() > 1;
    const double response_node = response_nodes[0], reference_node = reference_nodes[0];
    if (with_nodes_) {
      say(RemarkKind::kSeveralNodes, {},
          {static_cast<double>(response_nodes.size()), static_cast<double>(reference_nodes.size()),
           response_node});
    } else if (response_node != reference_node) {
      say(RemarkKind::kTwoNodes, {}, {response_node, reference_node});
    }
  }

  // The direction's name; `sign` is turned by a negative one.
  std::string direction_name(const UniversalDof& dof, double& sign) {
    static constexpr std::array kNames = {"x", "x", "y", "z"};
    if (dof.direction < 0) sign = -sign;
    if (dof.direction == 0) say(RemarkKind::kDirectionMissing);
    const std::string name = kNames[std::abs(dof.direction)];
    return with_nodes_ ? name + "@" + std::to_string(dof.node) : name;
  }

  Eigen::VectorXd lines_of(const UniversalFunction& function) {
    Eigen::VectorXd lines = factor_to_hz(function, take_remark_) * function.abscissa;
    for (Eigen::Index i = 0; i < lines.size(); ++i) {
      if (lines[i] >= 0 && std::isfinite(lines[i]) && (i == 0 || lines[i] > lines[i - 1])) continue;
      throw DataError(source_.name, function.place(i == 0 ? 7 : 12).text(), number_text(lines[i]) + " Hz",
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
    throw DataError(source_.name, function.place(7).text(), lines_text(lines),
                    "expected the " + std::to_string(known.size()) + " lines of the functions before",
                    Remedy::kFunctions);
  }

  void add(dynamics::FrequencyResponse& frf, const UniversalFunction& function) {
    const Eigen::VectorXd lines = lines_of(function);
    const FrfUnit meaning = meaning_of(function, choice_, take_remark_);
    if (frf.entries.empty()) {
      frf.frequency_hz = lines;
      frf.quantity = meaning.quantity;
    }
    check_lines(frf, function, lines);
    if (meaning.quantity != frf.quantity) {
      throw DataError(source_.name, function.place(9).text(), axis_text(function.ordinate),
                      "expected the quantity of the functions before");
    }
    double factor = meaning.to_si;
    dynamics::FrequencyResponseEntry entry;
    entry.response = direction_name(function.response, factor);
    entry.reference = direction_name(function.reference, factor);
    for (std::size_t e = 0; e < frf.entries.size(); ++e) {
      if (!frf.entries[e].same_places(entry)) continue;
      throw DataError(source_.name, function.place(6).text(), entry.response + entry.reference,
                      "measured in function " + std::to_string(responses_[e]->number) +
                          " too: expected each pair of directions once",
                      Remedy::kFunctions);
    }
    entry.h = factor * function.values;
    for (Eigen::Index i = 0; i < entry.h.size(); ++i) {
      if (std::isfinite(entry.h[i].real()) && std::isfinite(entry.h[i].imag())) continue;
      // At 0 Hz, where nothing is learnt, many programs divide by zero.
      if (lines[i] > 0) {
        throw DataError(source_.name, function.place(12).text(), "line at " + number_text(lines[i]) + " Hz",
                        "expected a finite number");
      }
      entry.h[i] = 0;
    }
    frf.entries.push_back(std::move(entry));
  }

  void add_coherence(dynamics::FrequencyResponse& frf, const UniversalFunction& function) {
    if (!function.response.is_translation() || !function.reference.is_translation()) return;
    double sign = 1;  // does not matter
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
      say(RemarkKind::kCoherenceTakenAsPercent, function.place(12), {largest});
      entry->coherence /= 100;
    }
    entry->coherence = entry->coherence.cwiseMin(1).eval();
    entry->averages = choice_.averages;
  }

  void say(RemarkKind kind, const FilePlace& place = {}, std::vector<double> numbers = {}) {
    say(Remark{kind, "", place, "", "", std::move(numbers)});
  }

  // Once is enough: functions of one file are mostly alike.
  void say(Remark remark) {
    remark.file = source_.name;
    const bool said = std::any_of(said_.begin(), said_.end(),
                                  [&](const Remark& other) { return same_but_for_place(other, remark); });
    if (said) return;
    said_.push_back(remark);
    remarks_.push_back(std::move(remark));
  }

  const Source& source_;
  const FrfChoice& choice_;
  std::vector<Remark>& remarks_;
  const TakeRemark take_remark_;
  std::vector<Remark> left_out_, said_;
  std::vector<const UniversalFunction*> responses_, coherences_;
  int elsewhere_ = 0;  // functions at other nodes than the one that was chosen
  bool with_nodes_ = false;
};

}  // namespace

dynamics::FrequencyResponse frf_from_universal_file(const Source& source, const FrfChoice& choice,
                                                    std::vector<Remark>& remarks) {
  return Collector(source, choice, remarks).collect();
}

}  // namespace stablecut::document
