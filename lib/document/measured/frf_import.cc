#include "document/measured/frf_import.h"

#include <array>
#include <utility>

#include "base/number_text.h"
#include "document/kinds/frf_json.h"
#include "document/measured/frf_columns.h"
#include "document/measured/frf_uff.h"
#include "document/measured/universal_file.h"
#include "document/text/data_error.h"

namespace stablecut::document {
namespace {

constexpr std::array<std::pair<const char*, FrfForm>, 4> kForms = {{{"json", FrfForm::kJson},
                                                                    {"uff", FrfForm::kUniversalFile},
                                                                    {"csv", FrfForm::kColumns},
                                                                    {"frf", FrfForm::kCutPro}}};

}  // namespace

std::optional<FrfForm> frf_form_from_name(const std::string& name) {
  for (const auto& [word, form] : kForms) {
    if (name == word) return form;
  }
  return std::nullopt;
}

FrfForm frf_form_of(const Input& input, const FrfChoice& choice) {
  if (choice.form) return *choice.form;
  if (!input.document.is_null()) return FrfForm::kJson;
  return looks_like_universal_file(input.source.text) ? FrfForm::kUniversalFile : FrfForm::kColumns;
}

dynamics::FrequencyResponse import_frf(const Input& input, const FrfChoice& choice,
                                       std::vector<Remark>& remarks) {
  const FrfForm form = frf_form_of(input, choice);
  if (form == FrfForm::kUniversalFile) return frf_from_universal_file(input.source, choice, remarks);
  if (form != FrfForm::kJson) return frf_from_columns(input.source, choice, remarks);
  dynamics::FrequencyResponse frf = frf_from_json(input.document, input.source);
  if (choice.quantity && frf.quantity != *choice.quantity) {
    throw DataError(input.source.name, "/quantity", quantity_name(frf.quantity),
                    std::string("expected ") + quantity_name(*choice.quantity), Remedy::kQuantity);
  }
  return frf;
}

std::optional<FrfPart> frf_part_named(const std::string& directions) {
  FrfPart part;
  const auto comma = directions.find(',');
  if (comma != std::string::npos) {
    part.response = directions.substr(0, comma);
    part.reference = directions.substr(comma + 1);
  } else {
    // Two letters, each with a sign where it has one.
    std::size_t at = 0;
    for (std::string* side : {&part.response, &part.reference}) {
      if (at < directions.size() && (directions[at] == '-' || directions[at] == '+'))
        *side += directions[at++];
      if (at < directions.size()) *side += directions[at++];
    }
    if (at != directions.size()) return std::nullopt;
  }
  for (std::string side : {part.response, part.reference}) {
    take_sign(side);
    if (side.empty() || side[0] == '-' || side[0] == '+') return std::nullopt;
  }
  return part;
}

dynamics::FrequencyResponse import_frf_parts(const std::vector<FrfPart>& parts, const FrfChoice& choice,
                                             std::vector<Remark>& remarks) {
  dynamics::FrequencyResponse all;
  for (const FrfPart& part : parts) {
    const std::string& name = part.input.source.name;
    dynamics::FrequencyResponse frf = import_frf(part.input, choice, remarks);
    if (frf.entries.size() != 1) {
      throw DataError(name, "", std::to_string(frf.entries.size()) + " entries",
                      "expected one in each of several files", Remedy::kFunctions);
    }
    dynamics::FrequencyResponseEntry& entry = frf.entries[0];
    const std::string told = entry.response + entry.reference;
    std::string response = part.response, reference = part.reference;
    entry.h *= take_sign(response) * take_sign(reference);
    entry.response = response;
    entry.reference = reference;
    const FrfForm form = frf_form_of(part.input, choice);
    if ((form == FrfForm::kJson || form == FrfForm::kUniversalFile) && told != response + reference)
      remarks.push_back({RemarkKind::kDirectionsOverruled, name, {}, told, response + reference, {}});
    if (all.entries.empty()) {
      all = std::move(frf);
      continue;
    }
    if (frf.quantity != all.quantity)
      throw DataError(name, "", quantity_name(frf.quantity),
                      std::string("expected ") + quantity_name(all.quantity) + ", as in the first file");
    if (!dynamics::same_values(frf.frequency_hz, all.frequency_hz))
      throw DataError(name, "", lines_text(frf.frequency_hz),
                      "expected the lines of the first file, " + lines_text(all.frequency_hz));
    if (frf.window_decay_per_s != all.window_decay_per_s)
      throw DataError(name, "/window_decay_per_s", number_text(frf.window_decay_per_s),
                      "expected " + number_text(all.window_decay_per_s) + ", as in the first file");
    for (const auto& other : all.entries) {
      if (other.same_places(entry))
        throw DataError(name, "", entry.response + entry.reference, "expected each pair of directions once");
    }
    all.entries.push_back(std::move(entry));
  }
  return all;
}

}  // namespace stablecut::document
