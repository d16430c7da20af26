#include "document/kinds/tested_cut_json.h"

#include "base/units.h"

namespace stablecut::document {
namespace {

Json interval(const std::array<double, 2>& n_per_m2) {
  return {n_per_mm2_from_n_per_m2(n_per_m2[0]), n_per_mm2_from_n_per_m2(n_per_m2[1])};
}

// Kt, Kr and what goes with them, as a cut has them.
Json coefficients(double kt_n_per_m2, double kr_n_per_m2, const milling::CoefficientDeviations& deviations) {
  return {{"kt_n_per_mm2", n_per_mm2_from_n_per_m2(kt_n_per_m2)},
          {"kr_n_per_mm2", n_per_mm2_from_n_per_m2(kr_n_per_m2)},
          {"kt_std_n_per_mm2", n_per_mm2_from_n_per_m2(deviations.kt_n_per_m2)},
          {"kr_std_n_per_mm2", n_per_mm2_from_n_per_m2(deviations.kr_n_per_m2)},
          {"kt_kr_correlation", deviations.correlation}};
}

}  // namespace

Json tested_cut_to_json(const TestedCutDocument& document) {
  Json result = {{"format", "stablecut/cut/1"}};
  for (const auto& [name, value] : document.cut.items()) {
    // What was known of the coefficients before is no longer.
    if (name != "format" && name != "provenance" && name != "identification" && name != "posterior")
      result[name] = value;
  }
  const milling::CoefficientPosterior& found = document.posterior;
  result.update(coefficients(found.kt_n_per_m2, found.kr_n_per_m2, found.deviations));
  Json cuts = Json::array();
  for (std::size_t i = 0; i < document.cuts.size(); ++i) {
    const MeasuredCut& cut = document.cuts[i];
    cuts.push_back({{"depth_mm", cut.depth_mm},
                    {"speed_rpm", cut.speed_rpm},
                    {"observed", *cut.observed_stable ? "stable" : "chatter"},
                    {"stable_probability", found.stable_share[static_cast<Eigen::Index>(i)]}});
  }
  const milling::Cutter& prior = document.prior.cutter;
  result["posterior"] = {
      {"kt_interval_95_n_per_mm2", interval(found.kt_95_n_per_m2)},
      {"kr_interval_95_n_per_mm2", interval(found.kr_95_n_per_m2)},
      {"prior", coefficients(prior.kt_n_per_m2, prior.kr_n_per_m2, document.prior.deviations)},
      {"samples", document.request.samples},
      {"effective_samples", found.effective_samples},
      {"wrong_share", document.request.wrong_share},
      {"as_unlikely_share", found.as_unlikely_share},
      {"contradicting", found.contradicting},
      {"cuts", std::move(cuts)}};
  return result;
}

}  // namespace stablecut::document
