#include "document/kinds/identified_cut_json.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace stablecut::document {
namespace {

using milling::CoefficientVerdict;
using milling::kCoefficients;

struct Name {
  const char* value;
  const char* deviation;
  double si;  // a unit in SI
};
constexpr std::array<Name, kCoefficients> kNames = {
    Name{"kt_n_per_mm2", "kt_std_n_per_mm2", 1e6}, {"kr_n_per_mm2", "kr_std_n_per_mm2", 1e6},
    {"kte_n_per_mm", "kte_std_n_per_mm", 1e3},     {"kre_n_per_mm", "kre_std_n_per_mm", 1e3},
    {"ka_n_per_mm2", "ka_std_n_per_mm2", 1e6},     {"kae_n_per_mm", "kae_std_n_per_mm", 1e3}};

const char* verdict_name(CoefficientVerdict verdict) {
  static const std::map<CoefficientVerdict, const char*> kWords = {
      {CoefficientVerdict::kIdentified, "identified"},
      {CoefficientVerdict::kHeld, "held"},
      {CoefficientVerdict::kUnmeasured, "unmeasured"},
      {CoefficientVerdict::kInseparable, "inseparable"}};
  return kWords.at(verdict);
}

Json residual_to_json(const milling::ForceResidual& residual) {
  Json item = {{"measured", residual.measured},
               {"degrees_of_freedom", residual.degrees_of_freedom},
               {"residual_rms_n", residual.rms_n},
               {"force_rms_n", residual.force_rms_n}};
  if (residual.chi_square_per_dof) item["chi_square_per_dof"] = *residual.chi_square_per_dof;
  if (residual.deviations_contradicted) item["deviations_contradicted"] = true;
  if (residual.not_linear) item["not_linear_in_feed"] = true;
  if (residual.uneven) item["uneven_scatter"] = true;
  return item;
}

bool deviation_known(const milling::ForceIdentification& found, int c) {
  return found.verdict[c] == CoefficientVerdict::kIdentified && found.deviations_known[c < 4 ? 0 : 1];
}

Json identification_to_json(const IdentifiedCut& identified) {
  const milling::ForceIdentification& found = identified.found;
  Json coefficients = Json::array(), covariance = Json::array();
  for (int c = 0; c < kCoefficients; ++c) {
    const double unit = kNames[c].si;
    Json item = {{"name", kNames[c].value}, {"verdict", verdict_name(found.verdict[c])}};
    if (found.verdict[c] == CoefficientVerdict::kIdentified) item["estimate"] = found.value[c] / unit;
    if (deviation_known(found, c)) {
      item["std"] = std::sqrt(found.covariance(c, c)) / unit;
      item["interval_95"] = {(found.value[c] - found.half_interval_95[c]) / unit,
                             (found.value[c] + found.half_interval_95[c]) / unit};
    }
    if (identified.held_at_zero[c]) item["held_at_zero"] = true;
    coefficients.push_back(std::move(item));
    Json row = Json::array();
    for (int other = 0; other < kCoefficients; ++other) {
      const bool known = deviation_known(found, c) && deviation_known(found, other);
      row.push_back(known ? Json(found.covariance(c, other) / unit / kNames[other].si) : Json(nullptr));
    }
    covariance.push_back(std::move(row));
  }
  return {{"coefficients", coefficients},
          {"covariance", covariance},
          {"in_plane", residual_to_json(found.residual[0])},
          {"axial", residual_to_json(found.residual[1])}};
}

}  // namespace

const char* coefficient_name(int coefficient) { return kNames[coefficient].value; }

Json identified_cut_to_json(const IdentifiedCut& identified) {
  Json document = {{"format", "stablecut/cut/1"}};
  for (const auto& [name, value] : identified.cut.items()) {
    if (name != "format" && name != "provenance") document[name] = value;
  }
  const milling::ForceIdentification& found = identified.found;
  for (int c = 0; c < kCoefficients; ++c) {
    document.erase(kNames[c].deviation);
    if (identified.value[c])
      document[kNames[c].value] = *identified.value[c] / kNames[c].si;
    else
      document.erase(kNames[c].value);
    if (deviation_known(found, c))
      document[kNames[c].deviation] = std::sqrt(found.covariance(c, c)) / kNames[c].si;
  }
  document.erase("kt_kr_correlation");
  if (deviation_known(found, 0) && deviation_known(found, 1)) {
    const double size = std::sqrt(found.covariance(0, 0) * found.covariance(1, 1));
    if (size > 0) document["kt_kr_correlation"] = std::clamp(found.covariance(0, 1) / size, -1.0, 1.0);
  }
  document["identification"] = identification_to_json(identified);
  return document;
}

}  // namespace stablecut::document
