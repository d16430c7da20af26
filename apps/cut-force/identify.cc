#include "identify.h"

#include "base/error.h"
#include "words.h"

namespace stablecut {
namespace {

using milling::Coefficient;
using milling::kCoefficients;

std::array<std::optional<double>, kCoefficients> values_of(const document::Json& document,
                                                           const document::CutDocument& cut) {
  const std::array<double, kCoefficients> values = {cut.cutter.kt_n_per_m2, cut.cutter.kr_n_per_m2,
                                                    cut.load.kte_n_per_m,   cut.load.kre_n_per_m,
                                                    cut.cutter.ka_n_per_m2, cut.load.kae_n_per_m};
  std::array<std::optional<double>, kCoefficients> result;
  for (int c = 0; c < kCoefficients; ++c) {
    if (document.contains(document::coefficient_name(c))) result[c] = values[c];
  }
  return result;
}

}  // namespace

document::IdentifiedCut identified_cut(const document::Json& document, const document::CutDocument& cut,
                                       std::vector<document::MeasuredForceRow> rows,
                                       const IdentifyRequest& request) {
  std::vector<milling::MeasuredForce> forces;
  for (document::MeasuredForceRow& row : rows) {
    for (std::optional<double>& force : row.force.force_n) {
      if (force && request.on_workpiece) *force = -*force;
    }
    forces.push_back(std::move(row.force));
  }
  document::IdentifiedCut result;
  result.cut = document;
  result.value = values_of(document, cut);
  std::array<std::optional<double>, kCoefficients> held;
  if (request.edges_of_cut) {
    for (const Coefficient edge : {Coefficient::kKte, Coefficient::kKre, Coefficient::kKae})
      held[static_cast<int>(edge)] = result.value[static_cast<int>(edge)].value_or(0);
  }
  result.found = milling::identify_coefficients(forces, held);
  if (const std::string text = no_coefficients_text(result.found); !text.empty()) throw NoAnswer(text);
  // A cut's coefficients are not below 0: the lowest of those that are, in its deviations, is held at 0.
  milling::ForceIdentification bounded = result.found;
  for (;;) {
    int lowest = -1;
    double depth = 0;
    for (int c = 1; c < kCoefficients; ++c) {
      if (bounded.verdict[c] != milling::CoefficientVerdict::kIdentified || !(bounded.value[c] < 0)) continue;
      const double below =
          -bounded.value[c] / (bounded.half_interval_95[c] > 0 ? bounded.half_interval_95[c] : 1);
      if (lowest < 0 || below > depth) {
        lowest = c;
        depth = below;
      }
    }
    if (lowest < 0) break;
    held[lowest] = 0;
    result.held_at_zero[lowest] = true;
    bounded = milling::identify_coefficients(forces, held);
  }
  for (int c = 0; c < kCoefficients; ++c) {
    if (result.found.verdict[c] == milling::CoefficientVerdict::kIdentified)
      result.value[c] = bounded.value[c];
  }
  return result;
}

}  // namespace stablecut
