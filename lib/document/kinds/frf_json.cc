#include "document/kinds/frf_json.h"

#include <cmath>

#include "base/units.h"
#include "document/text/data_error.h"
#include "document/text/node.h"

namespace stablecut::document {
namespace {

constexpr Bound kCoherence{.least = 0, .most = 1, .words = "a coherence from 0 to 1"};
constexpr Bound kAverages{.least = 1, .words = "a number of averages, at least 1"};

Eigen::VectorXd series(const Node& node, Eigen::Index lines, const Bound& bound = kAnyNumber) {
  Eigen::VectorXd values = node.numbers(bound);
  if (values.size() != lines) {
    node.fail("expected " + std::to_string(lines) + " numbers, one for each of /frequency_hz");
  }
  return values;
}

dynamics::FrequencyResponseEntry entry_from(const Node& node, Eigen::Index lines) {
  node.check_names({"response", "reference", "re", "im", "variance", "coherence", "averages",
                    "response_position_mm", "reference_position_mm"});
  dynamics::FrequencyResponseEntry entry;
  entry.response = node.at("response").text();
  entry.reference = node.at("reference").text();
  const double sign = take_sign(entry.response) * take_sign(entry.reference);
  if (entry.response.empty()) node.at("response").fail("expected a direction, such as x");
  if (entry.reference.empty()) node.at("reference").fail("expected a direction, such as x");
  entry.h.resize(lines);
  entry.h.real() = sign * series(node.at("re"), lines);
  entry.h.imag() = sign * series(node.at("im"), lines);
  if (const auto variance = node.find("variance")) entry.variance = series(*variance, lines, kNotNegative);
  if (const auto coherence = node.find("coherence")) {
    entry.coherence = series(*coherence, lines, kCoherence);
    entry.averages = node.at("averages").number(kAverages);
  }
  if (const auto position = node.find("response_position_mm")) {
    entry.response_position_m = metres_from_mm(position->number());
  }
  if (const auto position = node.find("reference_position_mm")) {
    entry.reference_position_m = metres_from_mm(position->number());
  }
  return entry;
}

}  // namespace

const char* quantity_name(dynamics::Quantity quantity) {
  switch (quantity) {
    case dynamics::Quantity::kReceptance:
      return "receptance";
    case dynamics::Quantity::kMobility:
      return "mobility";
    case dynamics::Quantity::kAccelerance:
      return "accelerance";
  }
  return "";
}

dynamics::Quantity quantity_from_name(const std::string& name) {
  return name == "receptance" ? dynamics::Quantity::kReceptance
         : name == "mobility" ? dynamics::Quantity::kMobility
                              : dynamics::Quantity::kAccelerance;
}

double take_sign(std::string& direction) {
  if (direction.empty() || (direction[0] != '-' && direction[0] != '+')) return 1;
  const double sign = direction[0] == '-' ? -1 : 1;
  direction.erase(0, 1);
  return sign;
}

Json number_list(const Eigen::VectorXd& values) {
  return Json(std::vector<double>(values.begin(), values.end()));
}

Json complex_series(const Eigen::VectorXcd& values) {
  return {{"re", number_list(values.real())}, {"im", number_list(values.imag())}};
}

dynamics::FrequencyResponse frf_from_json(const Json& document, const Source& source,
                                          const std::string& pointer) {
  const Node root = document_root(document, source, "frf", pointer);
  root.check_names({"format", "quantity", "frequency_hz", "h", "holder", "provenance"});
  dynamics::FrequencyResponse frf;
  frf.quantity = quantity_from_name(root.at("quantity").word({"receptance", "mobility", "accelerance"}));
  const Node frequency = root.at("frequency_hz");
  frf.frequency_hz = frequency.numbers(kNotNegative);
  if (frf.frequency_hz.size() == 0) frequency.fail("expected at least one frequency");
  for (Eigen::Index i = 1; i < frf.frequency_hz.size(); ++i) {
    if (!(frf.frequency_hz[i] > frf.frequency_hz[i - 1])) {
      frequency.items()[i].fail("expected increasing frequencies");
    }
  }
  for (const Node& item : root.at("h").items(1)) {
    dynamics::FrequencyResponseEntry entry = entry_from(item, frf.frequency_hz.size());
    // The same directions may be measured at several positions.
    for (const auto& other : frf.entries) {
      if (other.same_places(entry)) {
        throw DataError(source.name, item.pointer(), entry.response + entry.reference,
                        "expected each pair of directions once");
      }
    }
    frf.entries.push_back(std::move(entry));
  }
  return frf;
}

Json frf_to_json(const dynamics::FrequencyResponse& frf) {
  Json h = Json::array();
  for (const auto& entry : frf.entries) {
    Json item = {{"response", entry.response}, {"reference", entry.reference}};
    item.update(complex_series(entry.h));
    if (entry.variance.size() > 0) item["variance"] = number_list(entry.variance);
    if (entry.coherence.size() > 0) item["coherence"] = number_list(entry.coherence);
    if (entry.averages) item["averages"] = *entry.averages;
    if (entry.response_position_m) item["response_position_mm"] = mm_from_metres(*entry.response_position_m);
    if (entry.reference_position_m)
      item["reference_position_mm"] = mm_from_metres(*entry.reference_position_m);
    h.push_back(std::move(item));
  }
  return {{"format", "stablecut/frf/1"},
          {"quantity", quantity_name(frf.quantity)},
          {"frequency_hz", number_list(frf.frequency_hz)},
          {"h", std::move(h)}};
}

}  // namespace stablecut::document
