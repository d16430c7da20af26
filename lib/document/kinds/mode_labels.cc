#include "document/kinds/mode_labels.h"

#include <algorithm>

namespace stablecut::document {

std::vector<std::string> mode_labels(const Json& table) {
  std::vector<std::string> labels;
  for (const Json& mode : table.at("modes")) labels.push_back(mode.value("label", ""));
  return labels;
}

Json with_labels_of(const Json& reference, Json table, const dynamics::ModeComparison& comparison) {
  std::vector<std::string> known = mode_labels(reference);
  const std::size_t count = known.size();
  for (std::size_t k = 0; k < count; ++k) {
    if (known[k].empty()) known[k] = "m" + std::to_string(k + 1);
  }
  Json& modes = table.at("modes");
  for (Json& mode : modes) mode.erase("label");
  for (const dynamics::ModePair& pair : comparison.pairs) modes[pair.second]["label"] = known[pair.first];
  std::size_t number = count;
  for (const std::size_t mode : comparison.second_alone) {
    std::string label;
    do label = "m" + std::to_string(++number);
    while (std::find(known.begin(), known.end(), label) != known.end());
    known.push_back(label);
    modes[mode]["label"] = std::move(label);
  }
  return table;
}

}  // namespace stablecut::document
