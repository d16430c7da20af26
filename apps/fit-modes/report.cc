#include "report.h"

namespace stablecut {

document::Json fit_report(const modal::ModalFit& fit, const dynamics::FrequencyResponse& measured) {
  document::Json curves = document::Json::array();
  for (const modal::CurveFit& curve : fit.curves) {
    curves.push_back({{"response", curve.response},
                      {"reference", curve.reference},
                      {"relative_error", curve.relative_error},
                      {"reduced_chi_square", curve.reduced_chi_square}});
  }
  document::Json models = document::Json::array();
  for (const modal::ModelCriterion& criterion : fit.criteria) {
    models.push_back({{"model", kModelNames[static_cast<std::size_t>(criterion.model)]},
                      {"modes", criterion.modes},
                      {"parameters", criterion.parameters},
                      {"chi_square", criterion.chi_square},
                      {"bic", criterion.bic}});
  }
  document::Json report = {
      {"model", kModelNames[static_cast<std::size_t>(fit.mode_model)]},
      {"band_hz", document::Json::array(
                      {measured.frequency_hz[0], measured.frequency_hz[measured.frequency_hz.size() - 1]})},
      {"lines", measured.frequency_hz.size()},
      {"noise", fit.variance_given ? "given" : "estimated"},
      {"criterion", {{"name", "bic"}, {"inflation", fit.inflation}, {"models", std::move(models)}}},
      {"stopped_by", fit.limited_by_model ? "model error" : "noise"},
      {"relative_error", fit.relative_error},
      {"reduced_chi_square", fit.reduced_chi_square},
      {"curves", std::move(curves)}};
  if (fit.reciprocity)
    report["non_reciprocity"] = {{"index", fit.reciprocity->index}, {"of_noise", fit.reciprocity->noise}};
  return report;
}

document::Json stabilization_to_json(const std::vector<modal::StabilizationOrder>& orders,
                                     const modal::ModalFit& fit,
                                     const dynamics::FrequencyResponse& measured) {
  constexpr const char* kStabilities[] = {"new", "frequency", "pole"};
  document::Json diagram = document::Json::array();
  for (const modal::StabilizationOrder& order : orders) {
    document::Json poles = document::Json::array();
    for (const modal::StabilizationPole& pole : order.poles) {
      poles.push_back({{"frequency_hz", pole.frequency_hz},
                       {"damping_ratio", pole.damping_ratio},
                       {"stable", kStabilities[static_cast<std::size_t>(pole.stability)]}});
    }
    diagram.push_back({{"pole_pairs", order.order}, {"poles", std::move(poles)}});
  }
  document::Json modes = document::Json::array();
  for (const dynamics::Mode& mode : fit.model.modes) {
    if (mode.out_of_band) continue;
    modes.push_back({{"frequency_hz", mode.frequency_hz}, {"damping_ratio", mode.damping_ratio}});
  }
  const Eigen::MatrixXd indicator = modal::mode_indicator(measured);
  document::Json values = document::Json::array();
  for (const auto& column : indicator.colwise())
    values.push_back(std::vector<double>(column.begin(), column.end()));
  return {{"format", "stablecut/stabilization/1"},
          {"frequency_hz", std::vector<double>(measured.frequency_hz.begin(), measured.frequency_hz.end())},
          {"singular_values_m_per_n", std::move(values)},
          {"orders", std::move(diagram)},
          {"modes", std::move(modes)}};
}

}  // namespace stablecut
