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
  if (fit.shared_poles > 0) report["shared_poles"] = fit.shared_poles;
  if (fit.reciprocity)
    report["non_reciprocity"] = {{"index", fit.reciprocity->index}, {"of_noise", fit.reciprocity->noise}};
  return report;
}

}  // namespace stablecut
