#include "document/kinds/stabilization_json.h"

namespace stablecut::document {
namespace {

Json order_to_json(const modal::StabilizationOrder& order) {
  constexpr const char* kStabilities[] = {"new", "frequency", "pole"};  // by modal::Stability
  Json poles = Json::array();
  for (const modal::StabilizationPole& pole : order.poles) {
    poles.push_back({{"frequency_hz", pole.frequency_hz},
                     {"damping_ratio", pole.damping_ratio},
                     {"stable", kStabilities[static_cast<std::size_t>(pole.stability)]}});
  }
  return {{"pole_pairs", order.order}, {"poles", std::move(poles)}};
}

}  // namespace

Json stabilization_to_json(const std::vector<modal::StabilizationOrder>& orders,
                           const std::vector<dynamics::Mode>& chosen,
                           const dynamics::FrequencyResponse& measured) {
  Json diagram = Json::array();
  for (const modal::StabilizationOrder& order : orders) diagram.push_back(order_to_json(order));
  Json modes = Json::array();
  for (const dynamics::Mode& mode : chosen) {
    if (mode.out_of_band) continue;
    modes.push_back({{"frequency_hz", mode.frequency_hz}, {"damping_ratio", mode.damping_ratio}});
  }
  const Eigen::MatrixXd indicator = modal::mode_indicator(measured);
  Json values = Json::array();
  for (const auto& column : indicator.colwise())
    values.push_back(std::vector<double>(column.begin(), column.end()));
  return {{"format", "stablecut/stabilization/1"},
          {"frequency_hz", std::vector<double>(measured.frequency_hz.begin(), measured.frequency_hz.end())},
          {"singular_values_m_per_n", std::move(values)},
          {"orders", std::move(diagram)},
          {"modes", std::move(modes)}};
}

}  // namespace stablecut::document
