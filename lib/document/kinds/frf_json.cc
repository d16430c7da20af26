#include "document/kinds/frf_json.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/number_text.h"
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

dynamics::ColumnCovariance covariance_from(const Node& node, Eigen::Index lines) {
  node.check_names({"response", "other", "reference", "re", "im"});
  dynamics::ColumnCovariance covariance;
  covariance.response = node.at("response").text();
  covariance.other = node.at("other").text();
  covariance.reference = node.at("reference").text();
  // The reference's sign turns both errors.
  take_sign(covariance.reference);
  const double sign = take_sign(covariance.response) * take_sign(covariance.other);
  covariance.value.resize(lines);
  covariance.value.real() = sign * series(node.at("re"), lines);
  covariance.value.imag() = sign * series(node.at("im"), lines);
  return covariance;
}

// Each pair of entries with one reference, once.
void read_covariances(const Node& list, dynamics::FrequencyResponse& frf) {
  for (const Node& item : list.items()) {
    dynamics::ColumnCovariance covariance = covariance_from(item, frf.frequency_hz.size());
    for (const auto& [name, direction] :
         {std::pair("response", &covariance.response), std::pair("other", &covariance.other)}) {
      if (!frf.find(*direction, covariance.reference))
        item.at(name).fail("expected the response of an entry with that reference");
    }
    const auto same = [&](const dynamics::ColumnCovariance& known) {
      return known.reference == covariance.reference &&
             ((known.response == covariance.response && known.other == covariance.other) ||
              (known.response == covariance.other && known.other == covariance.response));
    };
    if (covariance.response == covariance.other) item.fail("expected two responses");
    if (std::any_of(frf.covariances.begin(), frf.covariances.end(), same))
      item.fail("expected each pair of responses once");
    frf.covariances.push_back(std::move(covariance));
  }
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
  root.check_document_names({"quantity", "frequency_hz", "h", "covariances", "window_decay_per_s", "holder"});
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
  if (const auto covariances = root.find("covariances")) read_covariances(*covariances, frf);
  if (const auto decay = root.find("window_decay_per_s"))
    frf.window_decay_per_s = decay->number(kNotNegative);
  return frf;
}

void refuse_window(const dynamics::FrequencyResponse& frf, const Source& source, const std::string& pointer) {
  if (!(frf.window_decay_per_s > 0)) return;
  throw DataError(
      source.name, pointer + "/window_decay_per_s", number_text(frf.window_decay_per_s),
      "expected responses without an exponential window, or the table that fit-modes makes of them");
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
  Json document = {{"format", "stablecut/frf/1"},
                   {"quantity", quantity_name(frf.quantity)},
                   {"frequency_hz", number_list(frf.frequency_hz)},
                   {"h", std::move(h)}};
  if (frf.window_decay_per_s > 0) document["window_decay_per_s"] = frf.window_decay_per_s;
  if (frf.covariances.empty()) return document;
  Json covariances = Json::array();
  for (const auto& covariance : frf.covariances) {
    Json item = {
        {"response", covariance.response}, {"other", covariance.other}, {"reference", covariance.reference}};
    item.update(complex_series(covariance.value));
    covariances.push_back(std::move(item));
  }
  document["covariances"] = std::move(covariances);
  return document;
}

}  // namespace stablecut::document
