#include "document/kinds/mode_comparison_json.h"

namespace stablecut::document {
namespace {

Json modes_to(const std::vector<std::size_t>& modes, const dynamics::ModalModel& model,
              const std::vector<std::string>& labels) {
  Json list = Json::array();
  for (const std::size_t k : modes) {
    const dynamics::Mode& mode = model.modes[k];
    Json item = {{"mode", k + 1}, {"frequency_hz", mode.frequency_hz}, {"damping_ratio", mode.damping_ratio}};
    if (!labels[k].empty()) item["label"] = labels[k];
    list.push_back(std::move(item));
  }
  return list;
}

Json numbers_of(const std::vector<std::size_t>& modes) {
  Json list = Json::array();
  for (const std::size_t k : modes) list.push_back(k + 1);
  return list;
}

}  // namespace

Json mode_comparison_to_json(const dynamics::ModeComparison& comparison, const ComparedTable& first,
                             const ComparedTable& second) {
  Json assurance = Json::array();
  for (const auto& row : comparison.assurance.rowwise())
    assurance.push_back(std::vector<double>(row.begin(), row.end()));
  Json pairs = Json::array();
  for (const dynamics::ModePair& pair : comparison.pairs) {
    Json item = {{"first", pair.first + 1},
                 {"second", pair.second + 1},
                 {"mac", pair.assurance},
                 {"frequency_difference_hz", pair.frequency_hz},
                 {"damping_ratio_difference", pair.damping_ratio}};
    if (pair.frequency_std_hz) item["frequency_difference_std_hz"] = *pair.frequency_std_hz;
    if (pair.damping_std) item["damping_ratio_difference_std"] = *pair.damping_std;
    pairs.push_back(std::move(item));
  }
  return {{"format", "stablecut/mode-comparison/1"},
          {"dofs", comparison.dofs},
          {"first", modes_to(comparison.first, first.model, first.labels)},
          {"second", modes_to(comparison.second, second.model, second.labels)},
          {"mac", std::move(assurance)},
          {"pairs", std::move(pairs)},
          {"first_alone", numbers_of(comparison.first_alone)},
          {"second_alone", numbers_of(comparison.second_alone)}};
}

}  // namespace stablecut::document
